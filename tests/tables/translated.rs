// Made from shaders/math by `translate.rs`; not to be edited.
pub mod single {
pub fn attenuation(t: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_attenuation(::naga_rust_rt::into(t)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_attenuation(t: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    return (-t.min(::naga_rust_rt::Scalar(87f32))).exp();
}
pub fn phi_one_thin(t_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_phi_one_thin(::naga_rust_rt::into(t_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_phi_one_thin(t_1: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    return (::naga_rust_rt::Scalar(1f32) + (t_1 * (::naga_rust_rt::Scalar(-0.5f32) + (t_1 * (::naga_rust_rt::Scalar(0.1666665f32) + (t_1 * (::naga_rust_rt::Scalar(-0.041665334f32) + (t_1 * (::naga_rust_rt::Scalar(0.0083281435f32) + (t_1 * (::naga_rust_rt::Scalar(-0.0013777664f32) + (t_1 * (::naga_rust_rt::Scalar(0.00018494231f32) - (t_1 * ::naga_rust_rt::Scalar(0.000015930938f32)))))))))))))));
}
pub fn phi_one(t_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_phi_one(::naga_rust_rt::into(t_2)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_phi_one(t_2: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    if ::naga_rust_rt::Scalar::into_branch_condition(t_2.elementwise_lt(::naga_rust_rt::Scalar(1f32))) {
        let _e3 = v_phi_one_thin(t_2);
        return _e3;
    }
    let _e4 = v_attenuation(t_2);
    return ((::naga_rust_rt::Scalar(1f32) - _e4) / t_2);
}
pub fn erfcx(x: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_erfcx(::naga_rust_rt::into(x)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_erfcx(x: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    let u = ((x - ::naga_rust_rt::Scalar(2f32)) / (x + ::naga_rust_rt::Scalar(2f32)));
    let p = (::naga_rust_rt::Scalar(1.2769784f32) + (u * (::naga_rust_rt::Scalar(-0.09276308f32) + (u * (::naga_rust_rt::Scalar(-0.16603152f32) + (u * (::naga_rust_rt::Scalar(0.16403583f32) + (u * (::naga_rust_rt::Scalar(-0.054208256f32) + (u * (::naga_rust_rt::Scalar(-0.007942667f32) + (u * (::naga_rust_rt::Scalar(0.008678226f32) + (u * (::naga_rust_rt::Scalar(0.0010430774f32) + (u * (::naga_rust_rt::Scalar(-0.001382726f32) + (u * (::naga_rust_rt::Scalar(-0.00018362673f32) + (u * ::naga_rust_rt::Scalar(0.00015546013f32)))))))))))))))))))));
    return (p / (::naga_rust_rt::Scalar(1f32) + (::naga_rust_rt::Scalar(2f32) * x)));
}
pub fn phi_one_half(t_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_phi_one_half(::naga_rust_rt::into(t_3)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_phi_one_half(t_3: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    return (::naga_rust_rt::Scalar(0.99999994f32) + (t_3 * (::naga_rust_rt::Scalar(-0.4999924f32) + (t_3 * (::naga_rust_rt::Scalar(0.16654734f32) + (t_3 * (::naga_rust_rt::Scalar(-0.04099875f32) + (t_3 * ::naga_rust_rt::Scalar(0.0067685456f32)))))))));
}
pub fn thin_weights(
    a: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    b: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> ::naga_rust_rt::Vec2<f32> {
    ::naga_rust_rt::into(v_thin_weights(::naga_rust_rt::into(a), ::naga_rust_rt::into(b)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_thin_weights(
    a: ::naga_rust_rt::Scalar<f32>,
    b: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Vec2<f32> {
    let half_slope = (::naga_rust_rt::Scalar(0.5f32) * (b - a));
    let t_lo = (::naga_rust_rt::Scalar(0.11270166f32) * (a + (::naga_rust_rt::Scalar(0.11270166f32) * half_slope)));
    let t_mid = (::naga_rust_rt::Scalar(0.5f32) * (a + (::naga_rust_rt::Scalar(0.5f32) * half_slope)));
    let t_hi = (::naga_rust_rt::Scalar(0.88729835f32) * (a + (::naga_rust_rt::Scalar(0.88729835f32) * half_slope)));
    let t_6 = (::naga_rust_rt::Scalar(0.5f32) * (a + b));
    let _e23 = v_phi_one_half(t_lo);
    let _e25 = v_phi_one_half(t_hi);
    let _e30 = v_phi_one_half(t_mid);
    let front = ((((t_lo * _e23) + (t_hi * _e25)) * ::naga_rust_rt::Scalar(0.2777778f32)) + ((t_mid * _e30) * ::naga_rust_rt::Scalar(0.44444445f32)));
    let _e35 = v_phi_one_half(t_6);
    return <::naga_rust_rt::Vec2<f32>>::from_scalars((t_6 * _e35), front);
}
pub fn strength_position(t_4: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_strength_position(::naga_rust_rt::into(t_4)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_strength_position(t_4: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    return ((::naga_rust_rt::Scalar(1f32) + t_4).log2() * ::naga_rust_rt::Scalar(0.10032882f32)).clamp(::naga_rust_rt::Scalar(0f32), ::naga_rust_rt::Scalar(1f32));
}
pub fn psi_position(t_5: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_psi_position(::naga_rust_rt::into(t_5)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_psi_position(t_5: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    return (::naga_rust_rt::Scalar(1f32) - (::naga_rust_rt::Scalar(-0.25f32) * (::naga_rust_rt::Scalar(1f32) + t_5).log2()).exp2());
}
pub fn cubic_start(
    at: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    nodes: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_cubic_start(::naga_rust_rt::into(at), ::naga_rust_rt::into(nodes)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_cubic_start(
    at: ::naga_rust_rt::Scalar<f32>,
    nodes: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    return (at.floor() - ::naga_rust_rt::Scalar(1f32)).clamp(::naga_rust_rt::Scalar(0f32), (nodes - ::naga_rust_rt::Scalar(4f32)));
}
pub fn cubic_weights(offset: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> ::naga_rust_rt::Vec4<f32> {
    ::naga_rust_rt::into(v_cubic_weights(::naga_rust_rt::into(offset)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_cubic_weights(offset: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Vec4<f32> {
    let mirrored = offset.elementwise_gt(::naga_rust_rt::Scalar(2f32));
    let from_edge = offset.select((::naga_rust_rt::Scalar(3f32) - offset), mirrored);
    let at_edge = from_edge.elementwise_lt(::naga_rust_rt::Scalar(1f32));
    let t_7 = (from_edge - ::naga_rust_rt::Scalar(1f32)).select(from_edge, at_edge);
    let before = (t_7 * (::naga_rust_rt::Scalar(-0.5f32) + (t_7 * (::naga_rust_rt::Scalar(1f32) - (::naga_rust_rt::Scalar(0.5f32) * t_7)))));
    let begin = (::naga_rust_rt::Scalar(1f32) + ((t_7 * t_7) * ((::naga_rust_rt::Scalar(1.5f32) * t_7) - ::naga_rust_rt::Scalar(2.5f32))));
    let end = (t_7 * (::naga_rust_rt::Scalar(0.5f32) + (t_7 * (::naga_rust_rt::Scalar(2f32) - (::naga_rust_rt::Scalar(1.5f32) * t_7)))));
    let after = ((t_7 * t_7) * ((::naga_rust_rt::Scalar(0.5f32) * t_7) - ::naga_rust_rt::Scalar(0.5f32)));
    let inner = <::naga_rust_rt::Vec4<f32>>::from_scalars(before, begin, end, after);
    let edge = <::naga_rust_rt::Vec4<f32>>::from_scalars((begin + (::naga_rust_rt::Scalar(3f32) * before)), (end - (::naga_rust_rt::Scalar(3f32) * before)), (after + before), ::naga_rust_rt::Scalar(0f32));
    let w = inner.select(edge, ::naga_rust_rt::Vec4::splat_from_scalar(at_edge));
    return w.select(<::naga_rust_rt::Vec4<f32>>::from_scalars(w.w(), w.z(), w.y(), w.x()), ::naga_rust_rt::Vec4::splat_from_scalar(mirrored));
}
pub fn is_short(
    extent: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    depth: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> bool {
    ::naga_rust_rt::into(v_is_short(::naga_rust_rt::into(extent), ::naga_rust_rt::into(depth)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_is_short(
    extent: ::naga_rust_rt::Scalar<f32>,
    depth: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<bool> {
    let mut local: ::naga_rust_rt::Scalar<bool>;

    if ::naga_rust_rt::Scalar::into_branch_condition(extent.elementwise_lt(::naga_rust_rt::Scalar(1f32))) {
        local = depth.elementwise_lt(::naga_rust_rt::Scalar(1f32));
    } else {
        local = ::naga_rust_rt::Scalar(false);
    }
    let _e9 = local;
    return _e9;
}
pub fn mean_transmittance_short(
    to_a: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    to_b: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    to_c: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    to_d: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    to_e: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_mean_transmittance_short(::naga_rust_rt::into(to_a), ::naga_rust_rt::into(to_b), ::naga_rust_rt::into(to_c), ::naga_rust_rt::into(to_d), ::naga_rust_rt::into(to_e)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_mean_transmittance_short(
    to_a: ::naga_rust_rt::Scalar<f32>,
    to_b: ::naga_rust_rt::Scalar<f32>,
    to_c: ::naga_rust_rt::Scalar<f32>,
    to_d: ::naga_rust_rt::Scalar<f32>,
    to_e: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let _e5 = v_attenuation(to_a);
    let _e6 = v_attenuation(to_e);
    let _e10 = v_attenuation(to_b);
    let _e11 = v_attenuation(to_d);
    let _e16 = v_attenuation(to_c);
    return (((::naga_rust_rt::Scalar(0.11846344f32) * (_e5 + _e6)) + (::naga_rust_rt::Scalar(0.23931433f32) * (_e10 + _e11))) + (::naga_rust_rt::Scalar(0.28444445f32) * _e16));
}
pub fn gaussian_span(
    start: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    extent_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> ::naga_rust_rt::Vec4<f32> {
    ::naga_rust_rt::into(v_gaussian_span(::naga_rust_rt::into(start), ::naga_rust_rt::into(extent_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_gaussian_span(
    start: ::naga_rust_rt::Scalar<f32>,
    extent_1: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Vec4<f32> {
    let stop = (start + extent_1);
    return <::naga_rust_rt::Vec4<f32>>::from_scalars((::naga_rust_rt::Scalar(-4f32) - start).clamp(::naga_rust_rt::Scalar(0f32), extent_1), (stop - ::naga_rust_rt::Scalar(4f32)).clamp(::naga_rust_rt::Scalar(0f32), extent_1), start.clamp(::naga_rust_rt::Scalar(-4f32), ::naga_rust_rt::Scalar(4f32)), stop.clamp(::naga_rust_rt::Scalar(-4f32), ::naga_rust_rt::Scalar(4f32)));
}
pub fn mean_transmittance_gaussian(
    span: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec4<f32>>,
    extent_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    j_start: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    j_end: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    depth_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_mean_transmittance_gaussian(::naga_rust_rt::into(span), ::naga_rust_rt::into(extent_2), ::naga_rust_rt::into(j_start), ::naga_rust_rt::into(j_end), ::naga_rust_rt::into(depth_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_mean_transmittance_gaussian(
    span: ::naga_rust_rt::Vec4<f32>,
    extent_2: ::naga_rust_rt::Scalar<f32>,
    j_start: ::naga_rust_rt::Scalar<f32>,
    j_end: ::naga_rust_rt::Scalar<f32>,
    depth_1: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let _e5 = v_attenuation(depth_1);
    return (((span.x() + (j_start - (_e5 * j_end))) + (_e5 * span.y())) / extent_2).clamp(::naga_rust_rt::Scalar(0f32), ::naga_rust_rt::Scalar(1f32));
}
pub fn wave_span(
    start_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    periods: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    turn: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> ::naga_rust_rt::Vec3<f32> {
    ::naga_rust_rt::into(v_wave_span(::naga_rust_rt::into(start_1), ::naga_rust_rt::into(periods), ::naga_rust_rt::into(turn)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_wave_span(
    start_1: ::naga_rust_rt::Scalar<f32>,
    periods: ::naga_rust_rt::Scalar<f32>,
    turn: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Vec3<f32> {
    let first = (start_1 - start_1.floor());
    let last = (first + periods);
    let starts = last.floor();
    return <::naga_rust_rt::Vec3<f32>>::from_scalars((turn * first), (turn * (last - starts)), starts);
}
pub fn mean_transmittance_wave(
    span_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec3<f32>>,
    extent_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    k: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec3<f32>>,
    rest: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    period: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    depth_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_mean_transmittance_wave(::naga_rust_rt::into(span_1), ::naga_rust_rt::into(extent_3), ::naga_rust_rt::into(k), ::naga_rust_rt::into(rest), ::naga_rust_rt::into(period), ::naga_rust_rt::into(depth_2)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_mean_transmittance_wave(
    span_1: ::naga_rust_rt::Vec3<f32>,
    extent_3: ::naga_rust_rt::Scalar<f32>,
    k: ::naga_rust_rt::Vec3<f32>,
    rest: ::naga_rust_rt::Scalar<f32>,
    period: ::naga_rust_rt::Scalar<f32>,
    depth_2: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let _e9 = v_phi_one((span_1.z() * period));
    let _e11 = v_phi_one(period);
    let series = ((span_1.z() * _e9) / _e11);
    let _e14 = v_attenuation(rest);
    let _e19 = v_attenuation(depth_2);
    let seen = ((k.x() + ((_e14 * k.z()) * series)) - (_e19 * k.y()));
    return (seen / extent_3).clamp(::naga_rust_rt::Scalar(0f32), ::naga_rust_rt::Scalar(1f32));
}
}
pub mod double {
pub fn attenuation(t: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_attenuation(::naga_rust_rt::into(t)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_attenuation(t: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    return (-t.min(::naga_rust_rt::Scalar(87f64))).exp();
}
pub fn phi_one_thin(t_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_phi_one_thin(::naga_rust_rt::into(t_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_phi_one_thin(t_1: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    return (::naga_rust_rt::Scalar(1f64) + (t_1 * (::naga_rust_rt::Scalar(-0.5f64) + (t_1 * (::naga_rust_rt::Scalar(0.16666649281978607f64) + (t_1 * (::naga_rust_rt::Scalar(-0.04166533425450325f64) + (t_1 * (::naga_rust_rt::Scalar(0.008328143507242203f64) + (t_1 * (::naga_rust_rt::Scalar(-0.0013777663698419929f64) + (t_1 * (::naga_rust_rt::Scalar(0.00018494231335353106f64) - (t_1 * ::naga_rust_rt::Scalar(0.000015930938388919458f64)))))))))))))));
}
pub fn phi_one(t_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_phi_one(::naga_rust_rt::into(t_2)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_phi_one(t_2: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    if ::naga_rust_rt::Scalar::into_branch_condition(t_2.elementwise_lt(::naga_rust_rt::Scalar(1f64))) {
        let _e3 = v_phi_one_thin(t_2);
        return _e3;
    }
    let _e4 = v_attenuation(t_2);
    return ((::naga_rust_rt::Scalar(1f64) - _e4) / t_2);
}
pub fn erfcx(x: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_erfcx(::naga_rust_rt::into(x)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_erfcx(x: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    let u = ((x - ::naga_rust_rt::Scalar(2f64)) / (x + ::naga_rust_rt::Scalar(2f64)));
    let p = (::naga_rust_rt::Scalar(1.2769783735275269f64) + (u * (::naga_rust_rt::Scalar(-0.09276308119297028f64) + (u * (::naga_rust_rt::Scalar(-0.16603152453899384f64) + (u * (::naga_rust_rt::Scalar(0.164035826921463f64) + (u * (::naga_rust_rt::Scalar(-0.05420825630426407f64) + (u * (::naga_rust_rt::Scalar(-0.007942667230963707f64) + (u * (::naga_rust_rt::Scalar(0.008678225800395012f64) + (u * (::naga_rust_rt::Scalar(0.0010430774418637156f64) + (u * (::naga_rust_rt::Scalar(-0.0013827260117977858f64) + (u * (::naga_rust_rt::Scalar(-0.00018362673290539533f64) + (u * ::naga_rust_rt::Scalar(0.00015546013310085982f64)))))))))))))))))))));
    return (p / (::naga_rust_rt::Scalar(1f64) + (::naga_rust_rt::Scalar(2f64) * x)));
}
pub fn phi_one_half(t_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_phi_one_half(::naga_rust_rt::into(t_3)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_phi_one_half(t_3: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    return (::naga_rust_rt::Scalar(0.9999999403953552f64) + (t_3 * (::naga_rust_rt::Scalar(-0.49999240040779114f64) + (t_3 * (::naga_rust_rt::Scalar(0.16654734313488007f64) + (t_3 * (::naga_rust_rt::Scalar(-0.04099874943494797f64) + (t_3 * ::naga_rust_rt::Scalar(0.006768545601516962f64)))))))));
}
pub fn thin_weights(
    a: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    b: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> ::naga_rust_rt::Vec2<f64> {
    ::naga_rust_rt::into(v_thin_weights(::naga_rust_rt::into(a), ::naga_rust_rt::into(b)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_thin_weights(
    a: ::naga_rust_rt::Scalar<f64>,
    b: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Vec2<f64> {
    let half_slope = (::naga_rust_rt::Scalar(0.5f64) * (b - a));
    let t_lo = (::naga_rust_rt::Scalar(0.1127016653792583f64) * (a + (::naga_rust_rt::Scalar(0.1127016653792583f64) * half_slope)));
    let t_mid = (::naga_rust_rt::Scalar(0.5f64) * (a + (::naga_rust_rt::Scalar(0.5f64) * half_slope)));
    let t_hi = (::naga_rust_rt::Scalar(0.8872983346207417f64) * (a + (::naga_rust_rt::Scalar(0.8872983346207417f64) * half_slope)));
    let t_6 = (::naga_rust_rt::Scalar(0.5f64) * (a + b));
    let _e23 = v_phi_one_half(t_lo);
    let _e25 = v_phi_one_half(t_hi);
    let _e30 = v_phi_one_half(t_mid);
    let front = ((((t_lo * _e23) + (t_hi * _e25)) * ::naga_rust_rt::Scalar(0.2777777777777778f64)) + ((t_mid * _e30) * ::naga_rust_rt::Scalar(0.4444444444444444f64)));
    let _e35 = v_phi_one_half(t_6);
    return <::naga_rust_rt::Vec2<f64>>::from_scalars((t_6 * _e35), front);
}
pub fn strength_position(t_4: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_strength_position(::naga_rust_rt::into(t_4)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_strength_position(t_4: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    return ((::naga_rust_rt::Scalar(1f64) + t_4).log2() * ::naga_rust_rt::Scalar(0.1003288150616121f64)).clamp(::naga_rust_rt::Scalar(0f64), ::naga_rust_rt::Scalar(1f64));
}
pub fn psi_position(t_5: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_psi_position(::naga_rust_rt::into(t_5)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_psi_position(t_5: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    return (::naga_rust_rt::Scalar(1f64) - (::naga_rust_rt::Scalar(-0.25f64) * (::naga_rust_rt::Scalar(1f64) + t_5).log2()).exp2());
}
pub fn cubic_start(
    at: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    nodes: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_cubic_start(::naga_rust_rt::into(at), ::naga_rust_rt::into(nodes)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_cubic_start(
    at: ::naga_rust_rt::Scalar<f64>,
    nodes: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    return (at.floor() - ::naga_rust_rt::Scalar(1f64)).clamp(::naga_rust_rt::Scalar(0f64), (nodes - ::naga_rust_rt::Scalar(4f64)));
}
pub fn cubic_weights(offset: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> ::naga_rust_rt::Vec4<f64> {
    ::naga_rust_rt::into(v_cubic_weights(::naga_rust_rt::into(offset)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_cubic_weights(offset: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Vec4<f64> {
    let mirrored = offset.elementwise_gt(::naga_rust_rt::Scalar(2f64));
    let from_edge = offset.select((::naga_rust_rt::Scalar(3f64) - offset), mirrored);
    let at_edge = from_edge.elementwise_lt(::naga_rust_rt::Scalar(1f64));
    let t_7 = (from_edge - ::naga_rust_rt::Scalar(1f64)).select(from_edge, at_edge);
    let before = (t_7 * (::naga_rust_rt::Scalar(-0.5f64) + (t_7 * (::naga_rust_rt::Scalar(1f64) - (::naga_rust_rt::Scalar(0.5f64) * t_7)))));
    let begin = (::naga_rust_rt::Scalar(1f64) + ((t_7 * t_7) * ((::naga_rust_rt::Scalar(1.5f64) * t_7) - ::naga_rust_rt::Scalar(2.5f64))));
    let end = (t_7 * (::naga_rust_rt::Scalar(0.5f64) + (t_7 * (::naga_rust_rt::Scalar(2f64) - (::naga_rust_rt::Scalar(1.5f64) * t_7)))));
    let after = ((t_7 * t_7) * ((::naga_rust_rt::Scalar(0.5f64) * t_7) - ::naga_rust_rt::Scalar(0.5f64)));
    let inner = <::naga_rust_rt::Vec4<f64>>::from_scalars(before, begin, end, after);
    let edge = <::naga_rust_rt::Vec4<f64>>::from_scalars((begin + (::naga_rust_rt::Scalar(3f64) * before)), (end - (::naga_rust_rt::Scalar(3f64) * before)), (after + before), ::naga_rust_rt::Scalar(0f64));
    let w = inner.select(edge, ::naga_rust_rt::Vec4::splat_from_scalar(at_edge));
    return w.select(<::naga_rust_rt::Vec4<f64>>::from_scalars(w.w(), w.z(), w.y(), w.x()), ::naga_rust_rt::Vec4::splat_from_scalar(mirrored));
}
pub fn is_short(
    extent: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    depth: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> bool {
    ::naga_rust_rt::into(v_is_short(::naga_rust_rt::into(extent), ::naga_rust_rt::into(depth)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_is_short(
    extent: ::naga_rust_rt::Scalar<f64>,
    depth: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<bool> {
    let mut local: ::naga_rust_rt::Scalar<bool>;

    if ::naga_rust_rt::Scalar::into_branch_condition(extent.elementwise_lt(::naga_rust_rt::Scalar(1f64))) {
        local = depth.elementwise_lt(::naga_rust_rt::Scalar(1f64));
    } else {
        local = ::naga_rust_rt::Scalar(false);
    }
    let _e9 = local;
    return _e9;
}
pub fn mean_transmittance_short(
    to_a: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    to_b: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    to_c: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    to_d: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    to_e: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_mean_transmittance_short(::naga_rust_rt::into(to_a), ::naga_rust_rt::into(to_b), ::naga_rust_rt::into(to_c), ::naga_rust_rt::into(to_d), ::naga_rust_rt::into(to_e)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_mean_transmittance_short(
    to_a: ::naga_rust_rt::Scalar<f64>,
    to_b: ::naga_rust_rt::Scalar<f64>,
    to_c: ::naga_rust_rt::Scalar<f64>,
    to_d: ::naga_rust_rt::Scalar<f64>,
    to_e: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let _e5 = v_attenuation(to_a);
    let _e6 = v_attenuation(to_e);
    let _e10 = v_attenuation(to_b);
    let _e11 = v_attenuation(to_d);
    let _e16 = v_attenuation(to_c);
    return (((::naga_rust_rt::Scalar(0.1184634425280945f64) * (_e5 + _e6)) + (::naga_rust_rt::Scalar(0.2393143352496832f64) * (_e10 + _e11))) + (::naga_rust_rt::Scalar(0.2844444444444444f64) * _e16));
}
pub fn gaussian_span(
    start: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    extent_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> ::naga_rust_rt::Vec4<f64> {
    ::naga_rust_rt::into(v_gaussian_span(::naga_rust_rt::into(start), ::naga_rust_rt::into(extent_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_gaussian_span(
    start: ::naga_rust_rt::Scalar<f64>,
    extent_1: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Vec4<f64> {
    let stop = (start + extent_1);
    return <::naga_rust_rt::Vec4<f64>>::from_scalars((::naga_rust_rt::Scalar(-4f64) - start).clamp(::naga_rust_rt::Scalar(0f64), extent_1), (stop - ::naga_rust_rt::Scalar(4f64)).clamp(::naga_rust_rt::Scalar(0f64), extent_1), start.clamp(::naga_rust_rt::Scalar(-4f64), ::naga_rust_rt::Scalar(4f64)), stop.clamp(::naga_rust_rt::Scalar(-4f64), ::naga_rust_rt::Scalar(4f64)));
}
pub fn mean_transmittance_gaussian(
    span: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec4<f64>>,
    extent_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    j_start: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    j_end: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    depth_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_mean_transmittance_gaussian(::naga_rust_rt::into(span), ::naga_rust_rt::into(extent_2), ::naga_rust_rt::into(j_start), ::naga_rust_rt::into(j_end), ::naga_rust_rt::into(depth_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_mean_transmittance_gaussian(
    span: ::naga_rust_rt::Vec4<f64>,
    extent_2: ::naga_rust_rt::Scalar<f64>,
    j_start: ::naga_rust_rt::Scalar<f64>,
    j_end: ::naga_rust_rt::Scalar<f64>,
    depth_1: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let _e5 = v_attenuation(depth_1);
    return (((span.x() + (j_start - (_e5 * j_end))) + (_e5 * span.y())) / extent_2).clamp(::naga_rust_rt::Scalar(0f64), ::naga_rust_rt::Scalar(1f64));
}
pub fn wave_span(
    start_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    periods: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    turn: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> ::naga_rust_rt::Vec3<f64> {
    ::naga_rust_rt::into(v_wave_span(::naga_rust_rt::into(start_1), ::naga_rust_rt::into(periods), ::naga_rust_rt::into(turn)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_wave_span(
    start_1: ::naga_rust_rt::Scalar<f64>,
    periods: ::naga_rust_rt::Scalar<f64>,
    turn: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Vec3<f64> {
    let first = (start_1 - start_1.floor());
    let last = (first + periods);
    let starts = last.floor();
    return <::naga_rust_rt::Vec3<f64>>::from_scalars((turn * first), (turn * (last - starts)), starts);
}
pub fn mean_transmittance_wave(
    span_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec3<f64>>,
    extent_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    k: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec3<f64>>,
    rest: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    period: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    depth_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_mean_transmittance_wave(::naga_rust_rt::into(span_1), ::naga_rust_rt::into(extent_3), ::naga_rust_rt::into(k), ::naga_rust_rt::into(rest), ::naga_rust_rt::into(period), ::naga_rust_rt::into(depth_2)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_mean_transmittance_wave(
    span_1: ::naga_rust_rt::Vec3<f64>,
    extent_3: ::naga_rust_rt::Scalar<f64>,
    k: ::naga_rust_rt::Vec3<f64>,
    rest: ::naga_rust_rt::Scalar<f64>,
    period: ::naga_rust_rt::Scalar<f64>,
    depth_2: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let _e9 = v_phi_one((span_1.z() * period));
    let _e11 = v_phi_one(period);
    let series = ((span_1.z() * _e9) / _e11);
    let _e14 = v_attenuation(rest);
    let _e19 = v_attenuation(depth_2);
    let seen = ((k.x() + ((_e14 * k.z()) * series)) - (_e19 * k.y()));
    return (seen / extent_3).clamp(::naga_rust_rt::Scalar(0f64), ::naga_rust_rt::Scalar(1f64));
}
}
