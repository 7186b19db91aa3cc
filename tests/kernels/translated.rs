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
    let t_4 = (::naga_rust_rt::Scalar(0.5f32) * (a + b));
    let _e23 = v_phi_one_half(t_lo);
    let _e25 = v_phi_one_half(t_hi);
    let _e30 = v_phi_one_half(t_mid);
    let front_1 = ((((t_lo * _e23) + (t_hi * _e25)) * ::naga_rust_rt::Scalar(0.2777778f32)) + ((t_mid * _e30) * ::naga_rust_rt::Scalar(0.44444445f32)));
    let _e35 = v_phi_one_half(t_4);
    return <::naga_rust_rt::Vec2<f32>>::from_scalars((t_4 * _e35), front_1);
}
pub fn gaussian_mean_short(
    v: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    extent: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    q: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_gaussian_mean_short(::naga_rust_rt::into(v), ::naga_rust_rt::into(extent), ::naga_rust_rt::into(q)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_gaussian_mean_short(
    v: ::naga_rust_rt::Scalar<f32>,
    extent: ::naga_rust_rt::Scalar<f32>,
    q: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let a_1 = (v + (extent * ::naga_rust_rt::Scalar(0.046910077f32)));
    let b_1 = (v + (extent * ::naga_rust_rt::Scalar(0.23076534f32)));
    let c = (v + (extent * ::naga_rust_rt::Scalar(0.5f32)));
    let d = (v + (extent * ::naga_rust_rt::Scalar(0.76923466f32)));
    let e = (v + (extent * ::naga_rust_rt::Scalar(0.95308995f32)));
    let _e20 = v_attenuation(((a_1 * a_1) + q));
    let _e23 = v_attenuation(((e * e) + q));
    let _e29 = v_attenuation(((b_1 * b_1) + q));
    let _e32 = v_attenuation(((d * d) + q));
    let _e39 = v_attenuation(((c * c) + q));
    return (((::naga_rust_rt::Scalar(0.11846344f32) * (_e20 + _e23)) + (::naga_rust_rt::Scalar(0.23931433f32) * (_e29 + _e32))) + (::naga_rust_rt::Scalar(0.28444445f32) * _e39));
}
pub fn gaussian_mean(
    p_front: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
    p_back: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_gaussian_mean(::naga_rust_rt::into(p_front), ::naga_rust_rt::into(p_back)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_gaussian_mean(
    p_front: ::naga_rust_rt::Vec2<f32>,
    p_back: ::naga_rust_rt::Vec2<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let mut local: ::naga_rust_rt::Scalar<bool>;

    let step = (p_back - p_front);
    let extent_1 = step.length();
    let along = <::naga_rust_rt::Vec2<f32>>::from_scalars(::naga_rust_rt::Scalar(1f32), ::naga_rust_rt::Scalar(0f32)).select((step / ::naga_rust_rt::Vec2::splat_from_scalar(extent_1.max(::naga_rust_rt::Scalar(0.000000000000000001f32)))), ::naga_rust_rt::Vec2::splat_from_scalar(extent_1.elementwise_gt(::naga_rust_rt::Scalar(0.000000000000000001f32))));
    let from_back = p_back.dot(p_back).elementwise_lt(p_front.dot(p_front));
    let near_end = p_front.select((-p_back), ::naga_rust_rt::Vec2::splat_from_scalar(from_back));
    let gen_v_start = near_end.dot(along);
    let across = ((near_end.x() * along.y()) - (near_end.y() * along.x()));
    let q_1 = (across * across);
    let gen_v_end = (gen_v_start + extent_1);
    if ::naga_rust_rt::Scalar::into_branch_condition(extent_1.elementwise_lt(::naga_rust_rt::Scalar(1f32))) {
        local = (extent_1 * (gen_v_start + gen_v_end).abs()).elementwise_lt(::naga_rust_rt::Scalar(2f32));
    } else {
        local = ::naga_rust_rt::Scalar(false);
    }
    let _e41 = local;
    if ::naga_rust_rt::Scalar::into_branch_condition(_e41) {
        let _e42 = v_gaussian_mean_short(gen_v_start, extent_1, q_1);
        return _e42;
    }
    let a_2 = gen_v_start.abs().min(gen_v_end.abs());
    let b_2 = gen_v_start.abs().max(gen_v_end.abs());
    let _e51 = v_attenuation(((a_2 * a_2) + q_1));
    let _e52 = v_erfcx(a_2);
    let tail_a = (_e51 * _e52);
    let _e56 = v_attenuation(((b_2 * b_2) + q_1));
    let _e57 = v_erfcx(b_2);
    let tail_b = (_e56 * _e57);
    let same_side = (gen_v_start * gen_v_end).elementwise_gt(::naga_rust_rt::Scalar(0f32));
    let _e62 = v_attenuation(q_1);
    let area = (((::naga_rust_rt::Scalar(2f32) * _e62) - tail_a) - tail_b).select((tail_a - tail_b), same_side);
    return ((::naga_rust_rt::Scalar(0.88622695f32) * area) / extent_1);
}
pub fn clip_to_range(
    within: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
    front: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    back: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    low: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    high: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> ::naga_rust_rt::Vec2<f32> {
    ::naga_rust_rt::into(v_clip_to_range(::naga_rust_rt::into(within), ::naga_rust_rt::into(front), ::naga_rust_rt::into(back), ::naga_rust_rt::into(low), ::naga_rust_rt::into(high)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_clip_to_range(
    within: ::naga_rust_rt::Vec2<f32>,
    front: ::naga_rust_rt::Scalar<f32>,
    back: ::naga_rust_rt::Scalar<f32>,
    low: ::naga_rust_rt::Scalar<f32>,
    high: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Vec2<f32> {
    let mut local_1: ::naga_rust_rt::Scalar<bool>;

    let change = (back - front);
    if ::naga_rust_rt::Scalar::into_branch_condition(change.abs().elementwise_lt(::naga_rust_rt::Scalar(0.000000000000000000000000000001f32))) {
        if ::naga_rust_rt::Scalar::into_branch_condition(front.elementwise_ge(low)) {
            local_1 = front.elementwise_le(high);
        } else {
            local_1 = ::naga_rust_rt::Scalar(false);
        }
        let _e14 = local_1;
        if ::naga_rust_rt::Scalar::into_branch_condition(_e14) {
            return within;
        }
        return <::naga_rust_rt::Vec2<f32>>::from_scalars(::naga_rust_rt::Scalar(1f32), ::naga_rust_rt::Scalar(0f32));
    }
    let x_low = ((low - front) / change);
    let x_high = ((high - front) / change);
    return <::naga_rust_rt::Vec2<f32>>::from_scalars(within.x().max(x_low.min(x_high)), within.y().min(x_low.max(x_high)));
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
    let t_4 = (::naga_rust_rt::Scalar(0.5f64) * (a + b));
    let _e23 = v_phi_one_half(t_lo);
    let _e25 = v_phi_one_half(t_hi);
    let _e30 = v_phi_one_half(t_mid);
    let front_1 = ((((t_lo * _e23) + (t_hi * _e25)) * ::naga_rust_rt::Scalar(0.2777777777777778f64)) + ((t_mid * _e30) * ::naga_rust_rt::Scalar(0.4444444444444444f64)));
    let _e35 = v_phi_one_half(t_4);
    return <::naga_rust_rt::Vec2<f64>>::from_scalars((t_4 * _e35), front_1);
}
pub fn gaussian_mean_short(
    v: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    extent: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    q: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_gaussian_mean_short(::naga_rust_rt::into(v), ::naga_rust_rt::into(extent), ::naga_rust_rt::into(q)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_gaussian_mean_short(
    v: ::naga_rust_rt::Scalar<f64>,
    extent: ::naga_rust_rt::Scalar<f64>,
    q: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let a_1 = (v + (extent * ::naga_rust_rt::Scalar(0.046910077030668f64)));
    let b_1 = (v + (extent * ::naga_rust_rt::Scalar(0.2307653449471585f64)));
    let c = (v + (extent * ::naga_rust_rt::Scalar(0.5f64)));
    let d = (v + (extent * ::naga_rust_rt::Scalar(0.7692346550528415f64)));
    let e = (v + (extent * ::naga_rust_rt::Scalar(0.953089922969332f64)));
    let _e20 = v_attenuation(((a_1 * a_1) + q));
    let _e23 = v_attenuation(((e * e) + q));
    let _e29 = v_attenuation(((b_1 * b_1) + q));
    let _e32 = v_attenuation(((d * d) + q));
    let _e39 = v_attenuation(((c * c) + q));
    return (((::naga_rust_rt::Scalar(0.1184634425280945f64) * (_e20 + _e23)) + (::naga_rust_rt::Scalar(0.2393143352496832f64) * (_e29 + _e32))) + (::naga_rust_rt::Scalar(0.2844444444444444f64) * _e39));
}
pub fn gaussian_mean(
    p_front: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
    p_back: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_gaussian_mean(::naga_rust_rt::into(p_front), ::naga_rust_rt::into(p_back)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_gaussian_mean(
    p_front: ::naga_rust_rt::Vec2<f64>,
    p_back: ::naga_rust_rt::Vec2<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let mut local: ::naga_rust_rt::Scalar<bool>;

    let step = (p_back - p_front);
    let extent_1 = step.length();
    let along = <::naga_rust_rt::Vec2<f64>>::from_scalars(::naga_rust_rt::Scalar(1f64), ::naga_rust_rt::Scalar(0f64)).select((step / ::naga_rust_rt::Vec2::splat_from_scalar(extent_1.max(::naga_rust_rt::Scalar(0.000000000000000001f64)))), ::naga_rust_rt::Vec2::splat_from_scalar(extent_1.elementwise_gt(::naga_rust_rt::Scalar(0.000000000000000001f64))));
    let from_back = p_back.dot(p_back).elementwise_lt(p_front.dot(p_front));
    let near_end = p_front.select((-p_back), ::naga_rust_rt::Vec2::splat_from_scalar(from_back));
    let gen_v_start = near_end.dot(along);
    let across = ((near_end.x() * along.y()) - (near_end.y() * along.x()));
    let q_1 = (across * across);
    let gen_v_end = (gen_v_start + extent_1);
    if ::naga_rust_rt::Scalar::into_branch_condition(extent_1.elementwise_lt(::naga_rust_rt::Scalar(1f64))) {
        local = (extent_1 * (gen_v_start + gen_v_end).abs()).elementwise_lt(::naga_rust_rt::Scalar(2f64));
    } else {
        local = ::naga_rust_rt::Scalar(false);
    }
    let _e41 = local;
    if ::naga_rust_rt::Scalar::into_branch_condition(_e41) {
        let _e42 = v_gaussian_mean_short(gen_v_start, extent_1, q_1);
        return _e42;
    }
    let a_2 = gen_v_start.abs().min(gen_v_end.abs());
    let b_2 = gen_v_start.abs().max(gen_v_end.abs());
    let _e51 = v_attenuation(((a_2 * a_2) + q_1));
    let _e52 = v_erfcx(a_2);
    let tail_a = (_e51 * _e52);
    let _e56 = v_attenuation(((b_2 * b_2) + q_1));
    let _e57 = v_erfcx(b_2);
    let tail_b = (_e56 * _e57);
    let same_side = (gen_v_start * gen_v_end).elementwise_gt(::naga_rust_rt::Scalar(0f64));
    let _e62 = v_attenuation(q_1);
    let area = (((::naga_rust_rt::Scalar(2f64) * _e62) - tail_a) - tail_b).select((tail_a - tail_b), same_side);
    return ((::naga_rust_rt::Scalar(0.886226925452758f64) * area) / extent_1);
}
pub fn clip_to_range(
    within: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
    front: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    back: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    low: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    high: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> ::naga_rust_rt::Vec2<f64> {
    ::naga_rust_rt::into(v_clip_to_range(::naga_rust_rt::into(within), ::naga_rust_rt::into(front), ::naga_rust_rt::into(back), ::naga_rust_rt::into(low), ::naga_rust_rt::into(high)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_clip_to_range(
    within: ::naga_rust_rt::Vec2<f64>,
    front: ::naga_rust_rt::Scalar<f64>,
    back: ::naga_rust_rt::Scalar<f64>,
    low: ::naga_rust_rt::Scalar<f64>,
    high: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Vec2<f64> {
    let mut local_1: ::naga_rust_rt::Scalar<bool>;

    let change = (back - front);
    if ::naga_rust_rt::Scalar::into_branch_condition(change.abs().elementwise_lt(::naga_rust_rt::Scalar(0.000000000000000000000000000001f64))) {
        if ::naga_rust_rt::Scalar::into_branch_condition(front.elementwise_ge(low)) {
            local_1 = front.elementwise_le(high);
        } else {
            local_1 = ::naga_rust_rt::Scalar(false);
        }
        let _e14 = local_1;
        if ::naga_rust_rt::Scalar::into_branch_condition(_e14) {
            return within;
        }
        return <::naga_rust_rt::Vec2<f64>>::from_scalars(::naga_rust_rt::Scalar(1f64), ::naga_rust_rt::Scalar(0f64));
    }
    let x_low = ((low - front) / change);
    let x_high = ((high - front) / change);
    return <::naga_rust_rt::Vec2<f64>>::from_scalars(within.x().max(x_low.min(x_high)), within.y().min(x_low.max(x_high)));
}
}
