// Made from shaders/math by `translate.rs`; not to be edited.
pub mod single {
use crate::root::SquareRoot;
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
    let u_1 = ((x - ::naga_rust_rt::Scalar(2f32)) / (x + ::naga_rust_rt::Scalar(2f32)));
    let p_1 = (::naga_rust_rt::Scalar(1.2769784f32) + (u_1 * (::naga_rust_rt::Scalar(-0.09276308f32) + (u_1 * (::naga_rust_rt::Scalar(-0.16603152f32) + (u_1 * (::naga_rust_rt::Scalar(0.16403583f32) + (u_1 * (::naga_rust_rt::Scalar(-0.054208256f32) + (u_1 * (::naga_rust_rt::Scalar(-0.007942667f32) + (u_1 * (::naga_rust_rt::Scalar(0.008678226f32) + (u_1 * (::naga_rust_rt::Scalar(0.0010430774f32) + (u_1 * (::naga_rust_rt::Scalar(-0.001382726f32) + (u_1 * (::naga_rust_rt::Scalar(-0.00018362673f32) + (u_1 * ::naga_rust_rt::Scalar(0.00015546013f32)))))))))))))))))))));
    return (p_1 / (::naga_rust_rt::Scalar(1f32) + (::naga_rust_rt::Scalar(2f32) * x)));
}
pub fn phi_one_unit(t_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_phi_one_unit(::naga_rust_rt::into(t_3)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_phi_one_unit(t_3: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    return (::naga_rust_rt::Scalar(0.99999994f32) + (t_3 * (::naga_rust_rt::Scalar(-0.49999458f32) + (t_3 * (::naga_rust_rt::Scalar(0.16660522f32) + (t_3 * (::naga_rust_rt::Scalar(-0.041406598f32) + (t_3 * (::naga_rust_rt::Scalar(0.007823707f32) - (t_3 * ::naga_rust_rt::Scalar(0.0009071576f32)))))))))));
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
    let t_8 = (::naga_rust_rt::Scalar(0.5f32) * (a + b));
    let d = (::naga_rust_rt::Scalar(0.5f32) * (b - a));
    let level = (t_8 * (::naga_rust_rt::Scalar(0.5f32) + (t_8 * (::naga_rust_rt::Scalar(-0.1663547f32) + (t_8 * (::naga_rust_rt::Scalar(0.04012842f32) - (t_8 * ::naga_rust_rt::Scalar(0.005898007f32))))))));
    let slope = (::naga_rust_rt::Scalar(-0.16666667f32) + (t_8 * (::naga_rust_rt::Scalar(0.08324046f32) + (t_8 * (::naga_rust_rt::Scalar(-0.024320815f32) + (t_8 * ::naga_rust_rt::Scalar(0.004133037f32)))))));
    let bend = (::naga_rust_rt::Scalar(-0.017194284f32) + (t_8 * (::naga_rust_rt::Scalar(0.01051915f32) - (t_8 * ::naga_rust_rt::Scalar(0.0040356745f32)))));
    let rest_2 = (::naga_rust_rt::Scalar(-0.0011748611f32) + (t_8 * ::naga_rust_rt::Scalar(0.00045987414f32)));
    let front_1 = (level + (d * (slope + (d * (bend + (d * (rest_2 - (d * ::naga_rust_rt::Scalar(0.00044541477f32)))))))));
    let _e49 = v_phi_one_unit(t_8);
    return <::naga_rust_rt::Vec2<f32>>::from_scalars((t_8 * _e49), front_1);
}
pub fn dawson_near(x_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_dawson_near(::naga_rust_rt::into(x_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_dawson_near(x_1: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    let y = (x_1 * x_1);
    let p_2 = (::naga_rust_rt::Scalar(1.0000001f32) + (y * (::naga_rust_rt::Scalar(-0.038065866f32) + (y * (::naga_rust_rt::Scalar(0.03287904f32) + (y * (::naga_rust_rt::Scalar(0.0011937979f32) + (y * ::naga_rust_rt::Scalar(0.00018023216f32)))))))));
    let q_1 = (::naga_rust_rt::Scalar(1f32) + (y * (::naga_rust_rt::Scalar(0.62860703f32) + (y * (::naga_rust_rt::Scalar(0.18524528f32) + (y * (::naga_rust_rt::Scalar(0.03334709f32) + (y * (::naga_rust_rt::Scalar(0.0038517737f32) + (y * ::naga_rust_rt::Scalar(0.00032483586f32)))))))))));
    return ((x_1 * p_2) / q_1);
}
pub fn dawson_far(x_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_dawson_far(::naga_rust_rt::into(x_2)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_dawson_far(x_2: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    let y_1 = (::naga_rust_rt::Scalar(1f32) / (x_2 * x_2));
    let p_3 = (::naga_rust_rt::Scalar(1.0000001f32) + (y_1 * (::naga_rust_rt::Scalar(0.49982157f32) + (y_1 * (::naga_rust_rt::Scalar(0.7885714f32) + (y_1 * (::naga_rust_rt::Scalar(-1.2632288f32) + (y_1 * (::naga_rust_rt::Scalar(129.16667f32) + (y_1 * (::naga_rust_rt::Scalar(-2472.1711f32) + (y_1 * (::naga_rust_rt::Scalar(26553.97f32) + (y_1 * (::naga_rust_rt::Scalar(-126146.45f32) + (y_1 * ::naga_rust_rt::Scalar(201245.73f32)))))))))))))))));
    return ((::naga_rust_rt::Scalar(0.5f32) * p_3) / x_2);
}
pub fn dawson(x_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_dawson(::naga_rust_rt::into(x_3)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_dawson(x_3: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    if ::naga_rust_rt::Scalar::into_branch_condition(x_3.elementwise_lt(::naga_rust_rt::Scalar(3f32))) {
        let _e3 = v_dawson_near(x_3);
        return _e3;
    }
    let _e4 = v_dawson_far(x_3);
    return _e4;
}
pub fn psi_thin(
    a_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    b_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_psi_thin(::naga_rust_rt::into(a_1), ::naga_rust_rt::into(b_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_psi_thin(
    a_1: ::naga_rust_rt::Scalar<f32>,
    b_1: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let slope_1 = (::naga_rust_rt::Scalar(0.5f32) * (b_1 - a_1));
    let _e10 = v_attenuation((::naga_rust_rt::Scalar(0.046910077f32) * (a_1 + (::naga_rust_rt::Scalar(0.046910077f32) * slope_1))));
    let _e16 = v_attenuation((::naga_rust_rt::Scalar(0.95308995f32) * (a_1 + (::naga_rust_rt::Scalar(0.95308995f32) * slope_1))));
    let _e25 = v_attenuation((::naga_rust_rt::Scalar(0.23076534f32) * (a_1 + (::naga_rust_rt::Scalar(0.23076534f32) * slope_1))));
    let _e31 = v_attenuation((::naga_rust_rt::Scalar(0.76923466f32) * (a_1 + (::naga_rust_rt::Scalar(0.76923466f32) * slope_1))));
    let _e41 = v_attenuation((::naga_rust_rt::Scalar(0.5f32) * (a_1 + (::naga_rust_rt::Scalar(0.5f32) * slope_1))));
    return (((::naga_rust_rt::Scalar(0.11846344f32) * (_e10 + _e16)) + (::naga_rust_rt::Scalar(0.23931433f32) * (_e25 + _e31))) + (::naga_rust_rt::Scalar(0.28444445f32) * _e41));
}
pub fn psi(
    a_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    b_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_psi(::naga_rust_rt::into(a_2), ::naga_rust_rt::into(b_2)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_psi(
    a_2: ::naga_rust_rt::Scalar<f32>,
    b_2: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    if ::naga_rust_rt::Scalar::into_branch_condition((a_2 + b_2).elementwise_lt(::naga_rust_rt::Scalar(3f32))) {
        let _e5 = v_psi_thin(a_2, b_2);
        return _e5;
    }
    let root = (::naga_rust_rt::Scalar(2f32) * (b_2 - a_2).abs().max((::naga_rust_rt::Scalar(0.000001f32) * (a_2 + b_2)))).sqrt();
    let p_4 = (a_2 / root);
    let r = (b_2 / root);
    let _e20 = v_attenuation((::naga_rust_rt::Scalar(0.5f32) * (a_2 + b_2)));
    if ::naga_rust_rt::Scalar::into_branch_condition(b_2.elementwise_ge(a_2)) {
        let _e22 = v_erfcx(p_4);
        let _e23 = v_erfcx(r);
        return ((::naga_rust_rt::Scalar(1.7724539f32) * (_e22 - (_e20 * _e23))) / root);
    }
    let _e29 = v_dawson(p_4);
    let _e30 = v_dawson(r);
    return ((::naga_rust_rt::Scalar(2f32) * (_e29 - (_e20 * _e30))) / root);
}
pub fn parts_node(
    a_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    b_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    h: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
    x_4: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    weight: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> ::naga_rust_rt::Vec2<f32> {
    ::naga_rust_rt::into(v_parts_node(::naga_rust_rt::into(a_3), ::naga_rust_rt::into(b_3), ::naga_rust_rt::into(h), ::naga_rust_rt::into(x_4), ::naga_rust_rt::into(weight)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_parts_node(
    a_3: ::naga_rust_rt::Scalar<f32>,
    b_3: ::naga_rust_rt::Scalar<f32>,
    h: ::naga_rust_rt::Vec2<f32>,
    x_4: ::naga_rust_rt::Scalar<f32>,
    weight: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Vec2<f32> {
    let y_2 = (::naga_rust_rt::Scalar(1f32) - x_4);
    let _e19 = v_attenuation((x_4 * (a_3 + ((::naga_rust_rt::Scalar(0.5f32) * x_4) * (b_3 - a_3)))));
    let value = ((weight * ((y_2 * h.x()) + (x_4 * h.y()))) * _e19);
    return <::naga_rust_rt::Vec2<f32>>::from_scalars((y_2 * value), (x_4 * value));
}
pub fn parts_thin(
    a_4: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    b_4: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    h_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
) -> ::naga_rust_rt::Vec2<f32> {
    ::naga_rust_rt::into(v_parts_thin(::naga_rust_rt::into(a_4), ::naga_rust_rt::into(b_4), ::naga_rust_rt::into(h_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_parts_thin(
    a_4: ::naga_rust_rt::Scalar<f32>,
    b_4: ::naga_rust_rt::Scalar<f32>,
    h_1: ::naga_rust_rt::Vec2<f32>,
) -> ::naga_rust_rt::Vec2<f32> {
    let _e5 = v_parts_node(a_4, b_4, h_1, ::naga_rust_rt::Scalar(0.03376524f32), ::naga_rust_rt::Scalar(0.085662246f32));
    let _e8 = v_parts_node(a_4, b_4, h_1, ::naga_rust_rt::Scalar(0.16939531f32), ::naga_rust_rt::Scalar(0.18038079f32));
    let _e12 = v_parts_node(a_4, b_4, h_1, ::naga_rust_rt::Scalar(0.3806904f32), ::naga_rust_rt::Scalar(0.23395696f32));
    let _e16 = v_parts_node(a_4, b_4, h_1, ::naga_rust_rt::Scalar(0.6193096f32), ::naga_rust_rt::Scalar(0.23395696f32));
    let _e20 = v_parts_node(a_4, b_4, h_1, ::naga_rust_rt::Scalar(0.8306047f32), ::naga_rust_rt::Scalar(0.18038079f32));
    let _e24 = v_parts_node(a_4, b_4, h_1, ::naga_rust_rt::Scalar(0.96623474f32), ::naga_rust_rt::Scalar(0.085662246f32));
    return (((((_e5 + _e8) + _e12) + _e16) + _e20) + _e24);
}
pub fn color_weights(
    a_5: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    b_5: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> ::naga_rust_rt::Vec2<f32> {
    ::naga_rust_rt::into(v_color_weights(::naga_rust_rt::into(a_5), ::naga_rust_rt::into(b_5)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_color_weights(
    a_5: ::naga_rust_rt::Scalar<f32>,
    b_5: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Vec2<f32> {
    if ::naga_rust_rt::Scalar::into_branch_condition((a_5 + b_5).elementwise_lt(::naga_rust_rt::Scalar(4f32))) {
        let _e6 = v_parts_thin(a_5, b_5, <::naga_rust_rt::Vec2<f32>>::from_scalars(a_5, b_5));
        return _e6;
    }
    let _e7 = v_psi(a_5, b_5);
    let _e13 = v_attenuation((::naga_rust_rt::Scalar(0.5f32) * (a_5 + b_5)));
    return <::naga_rust_rt::Vec2<f32>>::from_scalars((::naga_rust_rt::Scalar(1f32) - _e7), (_e7 - _e13));
}
pub fn emission_weights_level(
    mean: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    half_change: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    rest: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> ::naga_rust_rt::Vec2<f32> {
    ::naga_rust_rt::into(v_emission_weights_level(::naga_rust_rt::into(mean), ::naga_rust_rt::into(half_change), ::naga_rust_rt::into(rest)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_emission_weights_level(
    mean: ::naga_rust_rt::Scalar<f32>,
    half_change: ::naga_rust_rt::Scalar<f32>,
    rest: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Vec2<f32> {
    let inverse = (::naga_rust_rt::Scalar(1f32) / mean);
    let i_zero = ((::naga_rust_rt::Scalar(1f32) - rest) * inverse);
    let i_one = ((i_zero - rest) * inverse);
    let i_two = (((::naga_rust_rt::Scalar(2f32) * i_one) - rest) * inverse);
    let i_three = (((::naga_rust_rt::Scalar(3f32) * i_two) - rest) * inverse);
    let i_four = (((::naga_rust_rt::Scalar(4f32) * i_three) - rest) * inverse);
    let i_five = (((::naga_rust_rt::Scalar(5f32) * i_four) - rest) * inverse);
    let half_square = ((::naga_rust_rt::Scalar(0.5f32) * half_change) * half_change);
    let all = ((i_zero + (half_change * (i_one - i_two))) + (half_square * ((i_two - (::naga_rust_rt::Scalar(2f32) * i_three)) + i_four)));
    let back_1 = ((i_one + (half_change * (i_two - i_three))) + (half_square * ((i_three - (::naga_rust_rt::Scalar(2f32) * i_four)) + i_five)));
    return <::naga_rust_rt::Vec2<f32>>::from_scalars((all - back_1).max(::naga_rust_rt::Scalar(0f32)), back_1.max(::naga_rust_rt::Scalar(0f32)));
}
pub fn emission_weights(
    a_6: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    b_6: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> ::naga_rust_rt::Vec2<f32> {
    ::naga_rust_rt::into(v_emission_weights(::naga_rust_rt::into(a_6), ::naga_rust_rt::into(b_6)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_emission_weights(
    a_6: ::naga_rust_rt::Scalar<f32>,
    b_6: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Vec2<f32> {
    let sum_1 = (a_6 + b_6);
    if ::naga_rust_rt::Scalar::into_branch_condition(sum_1.elementwise_lt(::naga_rust_rt::Scalar(4f32))) {
        let _e8 = v_parts_thin(a_6, b_6, <::naga_rust_rt::Vec2<f32>>::from_scalars(::naga_rust_rt::Scalar(1f32), ::naga_rust_rt::Scalar(1f32)));
        return _e8;
    }
    let change = (b_6 - a_6);
    let _e12 = v_attenuation((::naga_rust_rt::Scalar(0.5f32) * sum_1));
    if ::naga_rust_rt::Scalar::into_branch_condition(change.abs().elementwise_lt((::naga_rust_rt::Scalar(0.015f32) * sum_1).max(::naga_rust_rt::Scalar(0.15f32)))) {
        let _e23 = v_emission_weights_level((::naga_rust_rt::Scalar(0.5f32) * sum_1), (::naga_rust_rt::Scalar(0.5f32) * change), _e12);
        return _e23;
    }
    let _e24 = v_psi(a_6, b_6);
    let back_2 = (((::naga_rust_rt::Scalar(1f32) - _e12) - (a_6 * _e24)) / change).max(::naga_rust_rt::Scalar(0f32));
    return <::naga_rust_rt::Vec2<f32>>::from_scalars((_e24 - back_2).max(::naga_rust_rt::Scalar(0f32)), back_2);
}
pub fn linear_product_mean(
    f: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
    g: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_linear_product_mean(::naga_rust_rt::into(f), ::naga_rust_rt::into(g)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_linear_product_mean(
    f: ::naga_rust_rt::Vec2<f32>,
    g: ::naga_rust_rt::Vec2<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    return ((((f.x() * g.x()) + (f.y() * g.y())) / ::naga_rust_rt::Scalar(3f32)) + (((f.x() * g.y()) + (f.y() * g.x())) / ::naga_rust_rt::Scalar(6f32)));
}
pub fn line_at(
    piece: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec4<f32>>,
    u: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_line_at(::naga_rust_rt::into(piece), ::naga_rust_rt::into(u)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_line_at(
    piece: ::naga_rust_rt::Vec4<f32>,
    u: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let part = ((u - piece.x()) / (piece.z() - piece.x()).max(::naga_rust_rt::Scalar(0.000000000000000000000000000001f32))).clamp(::naga_rust_rt::Scalar(0f32), ::naga_rust_rt::Scalar(1f32));
    return (piece.y() + (part * (piece.w() - piece.y())));
}
pub fn power(
    x_5: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    p: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_power(::naga_rust_rt::into(x_5), ::naga_rust_rt::into(p)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_power(
    x_5: ::naga_rust_rt::Scalar<f32>,
    p: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let mut logarithm: ::naga_rust_rt::Scalar<f32>;

    if ::naga_rust_rt::Scalar::into_branch_condition((!x_5.elementwise_gt(::naga_rust_rt::Scalar(0.000000000000000000000000000001f32)))) {
        return ::naga_rust_rt::Scalar(0f32);
    }
    logarithm = x_5.log2();
    if ::naga_rust_rt::Scalar::into_branch_condition(x_5.elementwise_gt(::naga_rust_rt::Scalar(0.7f32))) {
        let u_2 = ((x_5 - ::naga_rust_rt::Scalar(1f32)) / (x_5 + ::naga_rust_rt::Scalar(1f32)));
        let q_2 = (u_2 * u_2);
        logarithm = ((::naga_rust_rt::Scalar(2.88539f32) * u_2) * (::naga_rust_rt::Scalar(1f32) + (q_2 * (::naga_rust_rt::Scalar(0.33333334f32) + (q_2 * (::naga_rust_rt::Scalar(0.2f32) + (q_2 * (::naga_rust_rt::Scalar(0.14285715f32) + (q_2 * ::naga_rust_rt::Scalar(0.11111111f32))))))))));
    }
    let _e32 = logarithm;
    return (p * _e32).max(::naga_rust_rt::Scalar(-125f32)).exp2();
}
pub fn fade(gradient: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec3<f32>>) -> f32 {
    ::naga_rust_rt::into(v_fade(::naga_rust_rt::into(gradient)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_fade(gradient: ::naga_rust_rt::Vec3<f32>) -> ::naga_rust_rt::Scalar<f32> {
    let squared = gradient.dot(gradient);
    return (squared / (squared + ::naga_rust_rt::Scalar(0.000001f32)));
}
pub fn normal_of(gradient_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec3<f32>>) -> ::naga_rust_rt::Vec3<f32> {
    ::naga_rust_rt::into(v_normal_of(::naga_rust_rt::into(gradient_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_normal_of(gradient_1: ::naga_rust_rt::Vec3<f32>) -> ::naga_rust_rt::Vec3<f32> {
    return (gradient_1 / ::naga_rust_rt::Vec3::splat_from_scalar(gradient_1.length().max(::naga_rust_rt::Scalar(0.000000000000000001f32))));
}
pub fn lit(
    gradient_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec3<f32>>,
    ray: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
    light: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec4<f32>>,
    material: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec3<f32>>,
) -> ::naga_rust_rt::Vec2<f32> {
    ::naga_rust_rt::into(v_lit(::naga_rust_rt::into(gradient_2), ::naga_rust_rt::into(ray), ::naga_rust_rt::into(light), ::naga_rust_rt::into(material)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_lit(
    gradient_2: ::naga_rust_rt::Vec3<f32>,
    ray: ::naga_rust_rt::Vec2<f32>,
    light: ::naga_rust_rt::Vec4<f32>,
    material: ::naga_rust_rt::Vec3<f32>,
) -> ::naga_rust_rt::Vec2<f32> {
    let _e4 = v_fade(gradient_2);
    let _e5 = v_normal_of(gradient_2);
    let half_way = (light.xyz() - <::naga_rust_rt::Vec3<f32>>::new_21(ray, ::naga_rust_rt::Scalar(1f32)).normalize());
    let glance = (_e5.dot(half_way).abs() / <::naga_rust_rt::Vec4<f32>>::new_31(half_way, ::naga_rust_rt::Scalar(0.001f32)).length());
    let brightness = (light.w() + (material.x() * _e5.dot(light.xyz()).abs()));
    let _e34 = v_power(glance.min(::naga_rust_rt::Scalar(1f32)), material.z());
    return <::naga_rust_rt::Vec2<f32>>::from_scalars((::naga_rust_rt::Scalar(1f32) + (_e4 * (brightness - ::naga_rust_rt::Scalar(1f32)))), ((_e4 * material.y()) * _e34));
}
pub fn outlined(
    gradient_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec3<f32>>,
    ray_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
    exponent: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    strength: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_outlined(::naga_rust_rt::into(gradient_3), ::naga_rust_rt::into(ray_1), ::naga_rust_rt::into(exponent), ::naga_rust_rt::into(strength)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_outlined(
    gradient_3: ::naga_rust_rt::Vec3<f32>,
    ray_1: ::naga_rust_rt::Vec2<f32>,
    exponent: ::naga_rust_rt::Scalar<f32>,
    strength: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let _e4 = v_normal_of(gradient_3);
    let direction = <::naga_rust_rt::Vec3<f32>>::new_21(ray_1, ::naga_rust_rt::Scalar(1f32)).normalize();
    let sine = _e4.cross(direction);
    let turned_away = (sine.dot(sine) / (::naga_rust_rt::Scalar(1f32) + _e4.dot(direction).abs()));
    let _e15 = v_fade(gradient_3);
    let _e19 = v_power(turned_away.min(::naga_rust_rt::Scalar(1f32)), exponent);
    return (::naga_rust_rt::Scalar(1f32) + ((_e15 * strength) * (_e19 - ::naga_rust_rt::Scalar(1f32))));
}
pub fn quarter_sine(x_6: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_quarter_sine(::naga_rust_rt::into(x_6)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_quarter_sine(x_6: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    let y_3 = (x_6 * x_6);
    return (x_6 * (::naga_rust_rt::Scalar(1.5707964f32) + (y_3 * (::naga_rust_rt::Scalar(-0.6459637f32) + (y_3 * (::naga_rust_rt::Scalar(0.07968968f32) + (y_3 * (::naga_rust_rt::Scalar(-0.0046737664f32) + (y_3 * ::naga_rust_rt::Scalar(0.00015148513f32))))))))));
}
pub fn sine_of_turns(t_4: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_sine_of_turns(::naga_rust_rt::into(t_4)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_sine_of_turns(t_4: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    let r_1 = (t_4 - (t_4 + ::naga_rust_rt::Scalar(0.5f32)).floor());
    let folded = ((::naga_rust_rt::Scalar(0.5f32) * r_1.sign()) - r_1);
    let _e15 = v_quarter_sine((::naga_rust_rt::Scalar(4f32) * r_1.select(folded, r_1.abs().elementwise_gt(::naga_rust_rt::Scalar(0.25f32)))));
    return _e15;
}
pub fn cosine_of_turns(t_5: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_cosine_of_turns(::naga_rust_rt::into(t_5)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_cosine_of_turns(t_5: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    let r_2 = (t_5 - (t_5 + ::naga_rust_rt::Scalar(0.5f32)).floor());
    let _e10 = v_quarter_sine((::naga_rust_rt::Scalar(1f32) - (::naga_rust_rt::Scalar(4f32) * r_2.abs())));
    return _e10;
}
pub fn sinc_complement(x_7: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_sinc_complement(::naga_rust_rt::into(x_7)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_sinc_complement(x_7: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    let h_2 = (::naga_rust_rt::Scalar(3.1415927f32) * x_7);
    let y_4 = (h_2 * h_2);
    if ::naga_rust_rt::Scalar::into_branch_condition(y_4.elementwise_lt(::naga_rust_rt::Scalar(2.25f32))) {
        return (y_4 * (::naga_rust_rt::Scalar(0.16666667f32) + (y_4 * (::naga_rust_rt::Scalar(-0.00833333f32) + (y_4 * (::naga_rust_rt::Scalar(0.000198404f32) + (y_4 * (::naga_rust_rt::Scalar(-0.000002748742f32) + (y_4 * ::naga_rust_rt::Scalar(0.000000022990204f32))))))))));
    }
    let _e22 = v_sine_of_turns((::naga_rust_rt::Scalar(0.5f32) * x_7));
    return (::naga_rust_rt::Scalar(1f32) - (_e22 / h_2));
}
pub fn bessel_one(x_8: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_bessel_one(::naga_rust_rt::into(x_8)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_bessel_one(x_8: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    let h_3 = (::naga_rust_rt::Scalar(3.1415927f32) * x_8);
    let y_5 = (h_3 * h_3);
    if ::naga_rust_rt::Scalar::into_branch_condition(y_5.elementwise_lt(::naga_rust_rt::Scalar(2.25f32))) {
        return (h_3 * (::naga_rust_rt::Scalar(0.33333334f32) + (y_5 * (::naga_rust_rt::Scalar(-0.033333335f32) + (y_5 * (::naga_rust_rt::Scalar(0.0011904762f32) + (y_5 * (::naga_rust_rt::Scalar(-0.000022045855f32) + (y_5 * (::naga_rust_rt::Scalar(0.00000025052108f32) - (y_5 * ::naga_rust_rt::Scalar(0.0000000019270852f32))))))))))));
    }
    let _e25 = v_sine_of_turns((::naga_rust_rt::Scalar(0.5f32) * x_8));
    let _e28 = v_cosine_of_turns((::naga_rust_rt::Scalar(0.5f32) * x_8));
    return ((_e25 - (h_3 * _e28)) / y_5);
}
pub fn strength_position(t_6: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_strength_position(::naga_rust_rt::into(t_6)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_strength_position(t_6: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    return ((::naga_rust_rt::Scalar(1f32) + t_6).log2() * ::naga_rust_rt::Scalar(0.10032882f32)).clamp(::naga_rust_rt::Scalar(0f32), ::naga_rust_rt::Scalar(1f32));
}
pub fn psi_position(t_7: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_psi_position(::naga_rust_rt::into(t_7)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_psi_position(t_7: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    return (::naga_rust_rt::Scalar(1f32) - (::naga_rust_rt::Scalar(-0.25f32) * (::naga_rust_rt::Scalar(1f32) + t_7).log2()).exp2());
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
    let t_9 = (from_edge - ::naga_rust_rt::Scalar(1f32)).select(from_edge, at_edge);
    let before = (t_9 * (::naga_rust_rt::Scalar(-0.5f32) + (t_9 * (::naga_rust_rt::Scalar(1f32) - (::naga_rust_rt::Scalar(0.5f32) * t_9)))));
    let begin = (::naga_rust_rt::Scalar(1f32) + ((t_9 * t_9) * ((::naga_rust_rt::Scalar(1.5f32) * t_9) - ::naga_rust_rt::Scalar(2.5f32))));
    let end = (t_9 * (::naga_rust_rt::Scalar(0.5f32) + (t_9 * (::naga_rust_rt::Scalar(2f32) - (::naga_rust_rt::Scalar(1.5f32) * t_9)))));
    let after = ((t_9 * t_9) * ((::naga_rust_rt::Scalar(0.5f32) * t_9) - ::naga_rust_rt::Scalar(0.5f32)));
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
    rest_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    period: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    depth_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_mean_transmittance_wave(::naga_rust_rt::into(span_1), ::naga_rust_rt::into(extent_3), ::naga_rust_rt::into(k), ::naga_rust_rt::into(rest_1), ::naga_rust_rt::into(period), ::naga_rust_rt::into(depth_2)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_mean_transmittance_wave(
    span_1: ::naga_rust_rt::Vec3<f32>,
    extent_3: ::naga_rust_rt::Scalar<f32>,
    k: ::naga_rust_rt::Vec3<f32>,
    rest_1: ::naga_rust_rt::Scalar<f32>,
    period: ::naga_rust_rt::Scalar<f32>,
    depth_2: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let _e9 = v_phi_one((span_1.z() * period));
    let _e11 = v_phi_one(period);
    let series = ((span_1.z() * _e9) / _e11);
    let _e14 = v_attenuation(rest_1);
    let _e19 = v_attenuation(depth_2);
    let seen = ((k.x() + ((_e14 * k.z()) * series)) - (_e19 * k.y()));
    return (seen / extent_3).clamp(::naga_rust_rt::Scalar(0f32), ::naga_rust_rt::Scalar(1f32));
}
pub fn cosine_mean(
    phases: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
    weights: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_cosine_mean(::naga_rust_rt::into(phases), ::naga_rust_rt::into(weights)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_cosine_mean(
    phases: ::naga_rust_rt::Vec2<f32>,
    weights: ::naga_rust_rt::Vec2<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let mut product: ::naga_rust_rt::Scalar<f32>;

    let width = (phases.y() - phases.x());
    let base = ((::naga_rust_rt::Scalar(0.5f32) * (phases.x() + phases.y())) + ::naga_rust_rt::Scalar(0.5f32)).floor();
    let middle = (::naga_rust_rt::Scalar(0.5f32) * ((phases.x() - base) + (phases.y() - base)));
    let _e20 = v_cosine_of_turns(middle);
    let _e21 = v_sinc_complement(width);
    let _e24 = v_sine_of_turns((::naga_rust_rt::Scalar(0.5f32) * middle));
    let mean_1 = (::naga_rust_rt::Scalar(0.5f32) * (::naga_rust_rt::Scalar(1f32) - (_e20 * (::naga_rust_rt::Scalar(1f32) - _e21)))).select(((_e24 * _e24) + ((::naga_rust_rt::Scalar(0.5f32) * _e20) * _e21)), _e20.elementwise_gt(::naga_rust_rt::Scalar(0f32)));
    let tilt_1 = (weights.y() - weights.x());
    product = ((::naga_rust_rt::Scalar(0.5f32) * (weights.x() + weights.y())) * mean_1);
    if ::naga_rust_rt::Scalar::into_branch_condition(tilt_1.elementwise_ne(::naga_rust_rt::Scalar(0f32))) {
        let _e52 = product;
        let _e55 = v_sine_of_turns(middle);
        let _e57 = v_bessel_one(width);
        product = (_e52 + (((::naga_rust_rt::Scalar(0.25f32) * tilt_1) * _e55) * _e57));
    }
    let _e60 = product;
    return _e60;
}
pub fn arch_part(
    near: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    far: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    near_weight: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    far_weight: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_arch_part(::naga_rust_rt::into(near), ::naga_rust_rt::into(far), ::naga_rust_rt::into(near_weight), ::naga_rust_rt::into(far_weight)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_arch_part(
    near: ::naga_rust_rt::Scalar<f32>,
    far: ::naga_rust_rt::Scalar<f32>,
    near_weight: ::naga_rust_rt::Scalar<f32>,
    far_weight: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let mut product_1: ::naga_rust_rt::Scalar<f32>;

    let middle_1 = (::naga_rust_rt::Scalar(0.5f32) * (near + far));
    let half_width = (::naga_rust_rt::Scalar(0.5f32) * (far - near));
    let tilt_2 = (far_weight - near_weight);
    let _e16 = v_sine_of_turns((::naga_rust_rt::Scalar(0.5f32) * middle_1));
    let _e18 = v_sinc_complement(half_width);
    product_1 = (((::naga_rust_rt::Scalar(0.5f32) * (near_weight + far_weight)) * _e16) * (::naga_rust_rt::Scalar(1f32) - _e18));
    if ::naga_rust_rt::Scalar::into_branch_condition(tilt_2.elementwise_ne(::naga_rust_rt::Scalar(0f32))) {
        let _e25 = product_1;
        let _e30 = v_cosine_of_turns((::naga_rust_rt::Scalar(0.5f32) * middle_1));
        let _e32 = v_bessel_one(half_width);
        product_1 = (_e25 + (((::naga_rust_rt::Scalar(0.5f32) * tilt_2) * _e30) * _e32));
    }
    let _e35 = product_1;
    return _e35;
}
pub fn arch_mean(
    phases_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
    weights_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
    alternate: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<bool>>,
) -> f32 {
    ::naga_rust_rt::into(v_arch_mean(::naga_rust_rt::into(phases_1), ::naga_rust_rt::into(weights_1), ::naga_rust_rt::into(alternate)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_arch_mean(
    phases_1: ::naga_rust_rt::Vec2<f32>,
    weights_1: ::naga_rust_rt::Vec2<f32>,
    alternate: ::naga_rust_rt::Scalar<bool>,
) -> ::naga_rust_rt::Scalar<f32> {
    let mut local_1: ::naga_rust_rt::Scalar<bool>;
    let mut sum: ::naga_rust_rt::Scalar<f32> = ::naga_rust_rt::Scalar(0f32);
    let mut local_2: ::naga_rust_rt::Scalar<bool>;
    let mut local_3: ::naga_rust_rt::Scalar<bool>;
    let mut count: ::naga_rust_rt::Scalar<f32>;
    let mut center: ::naga_rust_rt::Scalar<f32>;

    let rising = phases_1.y().elementwise_ge(phases_1.x());
    let low_2 = phases_1.x().min(phases_1.y());
    let high_2 = phases_1.x().max(phases_1.y());
    let w_low_1 = weights_1.y().select(weights_1.x(), rising);
    let w_high_1 = weights_1.x().select(weights_1.y(), rising);
    let first_1 = low_2.ceil();
    let last_1 = high_2.floor();
    let first_is_odd = (first_1 - (::naga_rust_rt::Scalar(2f32) * (::naga_rust_rt::Scalar(0.5f32) * first_1).floor())).elementwise_gt(::naga_rust_rt::Scalar(0.5f32));
    if ::naga_rust_rt::Scalar::into_branch_condition(first_1.elementwise_gt(last_1)) {
        if ::naga_rust_rt::Scalar::into_branch_condition(alternate) {
            local_1 = (!first_is_odd);
        } else {
            local_1 = ::naga_rust_rt::Scalar(false);
        }
        let _e33 = local_1;
        if ::naga_rust_rt::Scalar::into_branch_condition(_e33) {
            return ::naga_rust_rt::Scalar(0f32);
        }
        let from_last = (low_2 - last_1);
        let to_first = (first_1 - high_2);
        if ::naga_rust_rt::Scalar::into_branch_condition(from_last.elementwise_le(to_first)) {
            let _e39 = v_arch_part(from_last, (high_2 - last_1), w_low_1, w_high_1);
            return _e39;
        }
        let _e41 = v_arch_part(to_first, (first_1 - low_2), w_high_1, w_low_1);
        return _e41;
    }
    let left = (first_1 - low_2);
    let right = (high_2 - last_1);
    let width_1 = (high_2 - low_2).max(::naga_rust_rt::Scalar(0.000000000000000000000000000001f32));
    let tilt_3 = (w_high_1 - w_low_1);
    if ::naga_rust_rt::Scalar::into_branch_condition((!(!alternate))) {
        local_2 = first_is_odd;
    } else {
        local_2 = ::naga_rust_rt::Scalar(true);
    }
    let _e55 = local_2;
    if ::naga_rust_rt::Scalar::into_branch_condition(_e55) {
        let _e56 = sum;
        let _e61 = v_arch_part(::naga_rust_rt::Scalar(0f32), left, (w_low_1 + (tilt_3 * (left / width_1))), w_low_1);
        sum = (_e56 + (left * _e61));
    }
    let last_is_odd = (last_1 - (::naga_rust_rt::Scalar(2f32) * (::naga_rust_rt::Scalar(0.5f32) * last_1).floor())).elementwise_gt(::naga_rust_rt::Scalar(0.5f32));
    if ::naga_rust_rt::Scalar::into_branch_condition((!(!alternate))) {
        local_3 = (!last_is_odd);
    } else {
        local_3 = ::naga_rust_rt::Scalar(true);
    }
    let _e78 = local_3;
    if ::naga_rust_rt::Scalar::into_branch_condition(_e78) {
        let _e79 = sum;
        let _e84 = v_arch_part(::naga_rust_rt::Scalar(0f32), right, (w_high_1 - (tilt_3 * (right / width_1))), w_high_1);
        sum = (_e79 + (right * _e84));
    }
    count = (last_1 - first_1);
    center = (::naga_rust_rt::Scalar(0.5f32) * (first_1 + last_1));
    if ::naga_rust_rt::Scalar::into_branch_condition(alternate) {
        let start_2 = first_1.select((first_1 + ::naga_rust_rt::Scalar(1f32)), first_is_odd);
        count = (::naga_rust_rt::Scalar(0.5f32) * (last_1 - start_2)).ceil();
        let _e100 = count;
        center = ((start_2 + _e100) - ::naga_rust_rt::Scalar(0.5f32));
    }
    let _e104 = sum;
    let _e105 = count;
    let _e108 = center;
    sum = (_e104 + ((::naga_rust_rt::Scalar(0.63661975f32) * _e105) * (w_low_1 + (tilt_3 * ((_e108 - low_2) / width_1)))));
    let _e115 = sum;
    return (_e115 / width_1);
}
pub fn triangle_slope(
    near_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    far_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    near_weight_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    far_weight_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    duty: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_triangle_slope(::naga_rust_rt::into(near_1), ::naga_rust_rt::into(far_1), ::naga_rust_rt::into(near_weight_1), ::naga_rust_rt::into(far_weight_1), ::naga_rust_rt::into(duty)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_triangle_slope(
    near_1: ::naga_rust_rt::Scalar<f32>,
    far_1: ::naga_rust_rt::Scalar<f32>,
    near_weight_1: ::naga_rust_rt::Scalar<f32>,
    far_weight_1: ::naga_rust_rt::Scalar<f32>,
    duty: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let mut local_4: ::naga_rust_rt::Scalar<bool>;

    let foot = (::naga_rust_rt::Scalar(0.5f32) * (::naga_rust_rt::Scalar(1f32) - duty));
    let half_duty = (::naga_rust_rt::Scalar(0.5f32) * duty);
    let e_near = (near_1 - foot).select((half_duty - (::naga_rust_rt::Scalar(0.5f32) - near_1)), near_1.elementwise_gt(::naga_rust_rt::Scalar(0.25f32)));
    let e_far = (far_1 - foot).select((half_duty - (::naga_rust_rt::Scalar(0.5f32) - far_1)), far_1.elementwise_gt(::naga_rust_rt::Scalar(0.25f32)));
    let width_2 = (far_1 - near_1);
    if ::naga_rust_rt::Scalar::into_branch_condition(e_far.elementwise_gt(::naga_rust_rt::Scalar(0f32))) {
        local_4 = width_2.elementwise_gt(::naga_rust_rt::Scalar(0f32));
    } else {
        local_4 = ::naga_rust_rt::Scalar(false);
    }
    let _e33 = local_4;
    if ::naga_rust_rt::Scalar::into_branch_condition((!_e33)) {
        return ::naga_rust_rt::Scalar(0f32);
    }
    let below = e_near.elementwise_lt(::naga_rust_rt::Scalar(0f32));
    let start_3 = e_near.max(::naga_rust_rt::Scalar(0f32));
    let part_1 = width_2.select(e_far.min(width_2), below);
    let w_start = near_weight_1.select((far_weight_1 - ((far_weight_1 - near_weight_1) * (part_1 / width_2))), below);
    let sum_2 = ((((w_start * start_3) + (far_weight_1 * e_far)) / ::naga_rust_rt::Scalar(3f32)) + (((w_start * e_far) + (far_weight_1 * start_3)) / ::naga_rust_rt::Scalar(6f32)));
    return ((part_1 * sum_2) / half_duty);
}
pub fn triangle_period(
    low: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    high: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    w_low: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    w_high: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    valley: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    duty_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_triangle_period(::naga_rust_rt::into(low), ::naga_rust_rt::into(high), ::naga_rust_rt::into(w_low), ::naga_rust_rt::into(w_high), ::naga_rust_rt::into(valley), ::naga_rust_rt::into(duty_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_triangle_period(
    low: ::naga_rust_rt::Scalar<f32>,
    high: ::naga_rust_rt::Scalar<f32>,
    w_low: ::naga_rust_rt::Scalar<f32>,
    w_high: ::naga_rust_rt::Scalar<f32>,
    valley: ::naga_rust_rt::Scalar<f32>,
    duty_1: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let next = (valley + ::naga_rust_rt::Scalar(1f32));
    let width_3 = (high - low).max(::naga_rust_rt::Scalar(0.000000000000000000000000000001f32));
    let tilt_4 = (w_high - w_low);
    let up_near = (low - valley).min(::naga_rust_rt::Scalar(0.5f32));
    let up_far = (high - valley).min(::naga_rust_rt::Scalar(0.5f32));
    let down_near = (next - high).min(::naga_rust_rt::Scalar(0.5f32));
    let down_far = (next - low).min(::naga_rust_rt::Scalar(0.5f32));
    let to_peak = ((up_far - up_near) / width_3).min(::naga_rust_rt::Scalar(1f32));
    let from_peak = ((down_far - down_near) / width_3).min(::naga_rust_rt::Scalar(1f32));
    let _e34 = v_triangle_slope(up_near, up_far, w_low, (w_low + (tilt_4 * to_peak)), duty_1);
    let _e37 = v_triangle_slope(down_near, down_far, w_high, (w_high - (tilt_4 * from_peak)), duty_1);
    return (_e34 + _e37);
}
pub fn triangle_at(
    phase: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    duty_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_triangle_at(::naga_rust_rt::into(phase), ::naga_rust_rt::into(duty_2)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_triangle_at(
    phase: ::naga_rust_rt::Scalar<f32>,
    duty_2: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let t_10 = (phase - (phase + ::naga_rust_rt::Scalar(0.5f32)).floor()).abs();
    let e = (t_10 - (::naga_rust_rt::Scalar(0.5f32) * (::naga_rust_rt::Scalar(1f32) - duty_2))).select(((::naga_rust_rt::Scalar(0.5f32) * duty_2) - (::naga_rust_rt::Scalar(0.5f32) - t_10)), t_10.elementwise_gt(::naga_rust_rt::Scalar(0.25f32)));
    return (e.max(::naga_rust_rt::Scalar(0f32)) / (::naga_rust_rt::Scalar(0.5f32) * duty_2));
}
pub fn triangle_mean(
    phases_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
    weights_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
    duty_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_triangle_mean(::naga_rust_rt::into(phases_2), ::naga_rust_rt::into(weights_2), ::naga_rust_rt::into(duty_3)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_triangle_mean(
    phases_2: ::naga_rust_rt::Vec2<f32>,
    weights_2: ::naga_rust_rt::Vec2<f32>,
    duty_3: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let rising_1 = phases_2.y().elementwise_ge(phases_2.x());
    let low_3 = phases_2.x().min(phases_2.y());
    let high_3 = phases_2.x().max(phases_2.y());
    let w_low_2 = weights_2.y().select(weights_2.x(), rising_1);
    let w_high_2 = weights_2.x().select(weights_2.y(), rising_1);
    let width_4 = (high_3 - low_3);
    if ::naga_rust_rt::Scalar::into_branch_condition((!width_4.elementwise_gt(::naga_rust_rt::Scalar(0.000000000000000000000000000001f32)))) {
        let _e25 = v_triangle_at(low_3, duty_3);
        return ((::naga_rust_rt::Scalar(0.5f32) * (w_low_2 + w_high_2)) * _e25);
    }
    let first_2 = low_3.ceil();
    let last_2 = high_3.floor();
    if ::naga_rust_rt::Scalar::into_branch_condition(first_2.elementwise_gt(last_2)) {
        let _e30 = v_triangle_period(low_3, high_3, w_low_2, w_high_2, last_2, duty_3);
        return (_e30 / width_4);
    }
    let tilt_5 = (w_high_2 - w_low_2);
    let w_first = (w_low_2 + (tilt_5 * ((first_2 - low_3) / width_4)));
    let w_last = (w_high_2 - (tilt_5 * ((high_3 - last_2) / width_4)));
    let whole = (((::naga_rust_rt::Scalar(0.25f32) * duty_3) * (last_2 - first_2)) * (w_first + w_last));
    let _e49 = v_triangle_period(low_3, first_2, w_low_2, w_first, (first_2 - ::naga_rust_rt::Scalar(1f32)), duty_3);
    let _e51 = v_triangle_period(last_2, high_3, w_last, w_high_2, last_2, duty_3);
    return (((_e49 + whole) + _e51) / width_4);
}
pub fn cosine_at(phase_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>) -> f32 {
    ::naga_rust_rt::into(v_cosine_at(::naga_rust_rt::into(phase_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_cosine_at(phase_1: ::naga_rust_rt::Scalar<f32>) -> ::naga_rust_rt::Scalar<f32> {
    let _e7 = v_sine_of_turns((::naga_rust_rt::Scalar(0.5f32) * (phase_1 - (phase_1 + ::naga_rust_rt::Scalar(0.5f32)).floor())));
    return (_e7 * _e7);
}
pub fn arch_at(
    phase_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    alternate_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<bool>>,
) -> f32 {
    ::naga_rust_rt::into(v_arch_at(::naga_rust_rt::into(phase_2), ::naga_rust_rt::into(alternate_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_arch_at(
    phase_2: ::naga_rust_rt::Scalar<f32>,
    alternate_1: ::naga_rust_rt::Scalar<bool>,
) -> ::naga_rust_rt::Scalar<f32> {
    let mut local_5: ::naga_rust_rt::Scalar<bool>;

    let index = phase_2.floor();
    if ::naga_rust_rt::Scalar::into_branch_condition(alternate_1) {
        local_5 = (index - (::naga_rust_rt::Scalar(2f32) * (::naga_rust_rt::Scalar(0.5f32) * index).floor())).elementwise_gt(::naga_rust_rt::Scalar(0.5f32));
    } else {
        local_5 = ::naga_rust_rt::Scalar(false);
    }
    let _e14 = local_5;
    if ::naga_rust_rt::Scalar::into_branch_condition(_e14) {
        return ::naga_rust_rt::Scalar(0f32);
    }
    let _e22 = v_sine_of_turns((::naga_rust_rt::Scalar(0.5f32) * (phase_2 - (phase_2 + ::naga_rust_rt::Scalar(0.5f32)).floor())));
    return _e22.abs();
}
pub fn gaussian_mean_short(
    v: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    extent_4: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    q: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    weight_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    tilt: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_gaussian_mean_short(::naga_rust_rt::into(v), ::naga_rust_rt::into(extent_4), ::naga_rust_rt::into(q), ::naga_rust_rt::into(weight_1), ::naga_rust_rt::into(tilt)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_gaussian_mean_short(
    v: ::naga_rust_rt::Scalar<f32>,
    extent_4: ::naga_rust_rt::Scalar<f32>,
    q: ::naga_rust_rt::Scalar<f32>,
    weight_1: ::naga_rust_rt::Scalar<f32>,
    tilt: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let mut product_2: ::naga_rust_rt::Scalar<f32>;

    let a_7 = (v + (extent_4 * ::naga_rust_rt::Scalar(0.046910077f32)));
    let b_7 = (v + (extent_4 * ::naga_rust_rt::Scalar(0.23076534f32)));
    let c = (v + (extent_4 * ::naga_rust_rt::Scalar(0.5f32)));
    let d_1 = (v + (extent_4 * ::naga_rust_rt::Scalar(0.76923466f32)));
    let e_1 = (v + (extent_4 * ::naga_rust_rt::Scalar(0.95308995f32)));
    let _e22 = v_attenuation(((a_7 * a_7) + q));
    let _e25 = v_attenuation(((b_7 * b_7) + q));
    let _e28 = v_attenuation(((d_1 * d_1) + q));
    let _e31 = v_attenuation(((e_1 * e_1) + q));
    let outer = (::naga_rust_rt::Scalar(0.11846344f32) * (_e22 + _e31));
    let inner_1 = (::naga_rust_rt::Scalar(0.23931433f32) * (_e25 + _e28));
    let _e41 = v_attenuation(((c * c) + q));
    let mean_2 = ((outer + inner_1) + (::naga_rust_rt::Scalar(0.28444445f32) * _e41));
    product_2 = (weight_1 * mean_2);
    if ::naga_rust_rt::Scalar::into_branch_condition(tilt.elementwise_ne(::naga_rust_rt::Scalar(0f32))) {
        let _e49 = product_2;
        product_2 = (_e49 + (tilt * (((::naga_rust_rt::Scalar(0.5f32) * mean_2) + (::naga_rust_rt::Scalar(0.053674594f32) * (_e31 - _e22))) + (::naga_rust_rt::Scalar(0.06443171f32) * (_e28 - _e25)))));
    }
    let _e62 = product_2;
    return _e62;
}
pub fn gaussian_product_mean(
    p_front: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
    p_back: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
    weights_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_gaussian_product_mean(::naga_rust_rt::into(p_front), ::naga_rust_rt::into(p_back), ::naga_rust_rt::into(weights_3)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_gaussian_product_mean(
    p_front: ::naga_rust_rt::Vec2<f32>,
    p_back: ::naga_rust_rt::Vec2<f32>,
    weights_3: ::naga_rust_rt::Vec2<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let mut local_6: ::naga_rust_rt::Scalar<bool>;
    let mut product_3: ::naga_rust_rt::Scalar<f32>;

    let step = (p_back - p_front);
    let extent_5 = step.length();
    let along = <::naga_rust_rt::Vec2<f32>>::from_scalars(::naga_rust_rt::Scalar(1f32), ::naga_rust_rt::Scalar(0f32)).select((step / ::naga_rust_rt::Vec2::splat_from_scalar(extent_5.max(::naga_rust_rt::Scalar(0.000000000000000001f32)))), ::naga_rust_rt::Vec2::splat_from_scalar(extent_5.elementwise_gt(::naga_rust_rt::Scalar(0.000000000000000001f32))));
    let from_back = p_back.dot(p_back).elementwise_lt(p_front.dot(p_front));
    let near_end = p_front.select((-p_back), ::naga_rust_rt::Vec2::splat_from_scalar(from_back));
    let near_weight_2 = weights_3.x().select(weights_3.y(), from_back);
    let tilt_6 = (weights_3.y().select(weights_3.x(), from_back) - near_weight_2);
    let gen_v_start = near_end.dot(along);
    let across = ((near_end.x() * along.y()) - (near_end.y() * along.x()));
    let q_3 = (across * across);
    let gen_v_end = (gen_v_start + extent_5);
    if ::naga_rust_rt::Scalar::into_branch_condition(extent_5.elementwise_lt(::naga_rust_rt::Scalar(1f32))) {
        local_6 = (extent_5 * (gen_v_start + gen_v_end).abs()).elementwise_lt(::naga_rust_rt::Scalar(2f32));
    } else {
        local_6 = ::naga_rust_rt::Scalar(false);
    }
    let _e49 = local_6;
    if ::naga_rust_rt::Scalar::into_branch_condition(_e49) {
        let _e50 = v_gaussian_mean_short(gen_v_start, extent_5, q_3, near_weight_2, tilt_6);
        return _e50;
    }
    let a_8 = gen_v_start.abs().min(gen_v_end.abs());
    let b_8 = gen_v_start.abs().max(gen_v_end.abs());
    let _e59 = v_attenuation(((a_8 * a_8) + q_3));
    let _e62 = v_attenuation(((b_8 * b_8) + q_3));
    let _e63 = v_erfcx(a_8);
    let tail_a = (_e59 * _e63);
    let _e65 = v_erfcx(b_8);
    let tail_b = (_e62 * _e65);
    let same_side = (gen_v_start * gen_v_end).elementwise_gt(::naga_rust_rt::Scalar(0f32));
    let _e70 = v_attenuation(q_3);
    let area = (((::naga_rust_rt::Scalar(2f32) * _e70) - tail_a) - tail_b).select((tail_a - tail_b), same_side);
    let mean_3 = ((::naga_rust_rt::Scalar(0.88622695f32) * area) / extent_5);
    product_3 = (near_weight_2 * mean_3);
    if ::naga_rust_rt::Scalar::into_branch_condition(tilt_6.elementwise_ne(::naga_rust_rt::Scalar(0f32))) {
        let _e84 = product_3;
        product_3 = (_e84 + ((tilt_6 * (((::naga_rust_rt::Scalar(0.5f32) * (_e59 - _e62)) / extent_5) - (gen_v_start * mean_3)).max(::naga_rust_rt::Scalar(0f32))) / extent_5));
    }
    let _e96 = product_3;
    return _e96;
}
pub fn gaussian_mean(
    p_front_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
    p_back_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
) -> f32 {
    ::naga_rust_rt::into(v_gaussian_mean(::naga_rust_rt::into(p_front_1), ::naga_rust_rt::into(p_back_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_gaussian_mean(
    p_front_1: ::naga_rust_rt::Vec2<f32>,
    p_back_1: ::naga_rust_rt::Vec2<f32>,
) -> ::naga_rust_rt::Scalar<f32> {
    let _e5 = v_gaussian_product_mean(p_front_1, p_back_1, <::naga_rust_rt::Vec2<f32>>::from_scalars(::naga_rust_rt::Scalar(1f32), ::naga_rust_rt::Scalar(1f32)));
    return _e5;
}
pub fn clip_to_range(
    within: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f32>>,
    front: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    back: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    low_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
    high_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f32>>,
) -> ::naga_rust_rt::Vec2<f32> {
    ::naga_rust_rt::into(v_clip_to_range(::naga_rust_rt::into(within), ::naga_rust_rt::into(front), ::naga_rust_rt::into(back), ::naga_rust_rt::into(low_1), ::naga_rust_rt::into(high_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_clip_to_range(
    within: ::naga_rust_rt::Vec2<f32>,
    front: ::naga_rust_rt::Scalar<f32>,
    back: ::naga_rust_rt::Scalar<f32>,
    low_1: ::naga_rust_rt::Scalar<f32>,
    high_1: ::naga_rust_rt::Scalar<f32>,
) -> ::naga_rust_rt::Vec2<f32> {
    let mut local_7: ::naga_rust_rt::Scalar<bool>;

    let change_1 = (back - front);
    if ::naga_rust_rt::Scalar::into_branch_condition(change_1.abs().elementwise_lt(::naga_rust_rt::Scalar(0.000000000000000000000000000001f32))) {
        if ::naga_rust_rt::Scalar::into_branch_condition(front.elementwise_ge(low_1)) {
            local_7 = front.elementwise_le(high_1);
        } else {
            local_7 = ::naga_rust_rt::Scalar(false);
        }
        let _e14 = local_7;
        if ::naga_rust_rt::Scalar::into_branch_condition(_e14) {
            return within;
        }
        return <::naga_rust_rt::Vec2<f32>>::from_scalars(::naga_rust_rt::Scalar(1f32), ::naga_rust_rt::Scalar(0f32));
    }
    let x_low = ((low_1 - front) / change_1);
    let x_high = ((high_1 - front) / change_1);
    return <::naga_rust_rt::Vec2<f32>>::from_scalars(within.x().max(x_low.min(x_high)), within.y().min(x_low.max(x_high)));
}
}
pub mod double {
use crate::root::SquareRoot;
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
    let u_1 = ((x - ::naga_rust_rt::Scalar(2f64)) / (x + ::naga_rust_rt::Scalar(2f64)));
    let p_1 = (::naga_rust_rt::Scalar(1.2769783735275269f64) + (u_1 * (::naga_rust_rt::Scalar(-0.09276308119297028f64) + (u_1 * (::naga_rust_rt::Scalar(-0.16603152453899384f64) + (u_1 * (::naga_rust_rt::Scalar(0.164035826921463f64) + (u_1 * (::naga_rust_rt::Scalar(-0.05420825630426407f64) + (u_1 * (::naga_rust_rt::Scalar(-0.007942667230963707f64) + (u_1 * (::naga_rust_rt::Scalar(0.008678225800395012f64) + (u_1 * (::naga_rust_rt::Scalar(0.0010430774418637156f64) + (u_1 * (::naga_rust_rt::Scalar(-0.0013827260117977858f64) + (u_1 * (::naga_rust_rt::Scalar(-0.00018362673290539533f64) + (u_1 * ::naga_rust_rt::Scalar(0.00015546013310085982f64)))))))))))))))))))));
    return (p_1 / (::naga_rust_rt::Scalar(1f64) + (::naga_rust_rt::Scalar(2f64) * x)));
}
pub fn phi_one_unit(t_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_phi_one_unit(::naga_rust_rt::into(t_3)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_phi_one_unit(t_3: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    return (::naga_rust_rt::Scalar(0.9999999403953552f64) + (t_3 * (::naga_rust_rt::Scalar(-0.49999457597732544f64) + (t_3 * (::naga_rust_rt::Scalar(0.16660521924495697f64) + (t_3 * (::naga_rust_rt::Scalar(-0.041406597942113876f64) + (t_3 * (::naga_rust_rt::Scalar(0.007823706604540348f64) - (t_3 * ::naga_rust_rt::Scalar(0.0009071576059795916f64)))))))))));
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
    let t_8 = (::naga_rust_rt::Scalar(0.5f64) * (a + b));
    let d = (::naga_rust_rt::Scalar(0.5f64) * (b - a));
    let level = (t_8 * (::naga_rust_rt::Scalar(0.5f64) + (t_8 * (::naga_rust_rt::Scalar(-0.166354700922966f64) + (t_8 * (::naga_rust_rt::Scalar(0.040128421038389206f64) - (t_8 * ::naga_rust_rt::Scalar(0.005898007191717625f64))))))));
    let slope = (::naga_rust_rt::Scalar(-0.16666666666666666f64) + (t_8 * (::naga_rust_rt::Scalar(0.08324045687913895f64) + (t_8 * (::naga_rust_rt::Scalar(-0.0243208147585392f64) + (t_8 * ::naga_rust_rt::Scalar(0.0041330368258059025f64)))))));
    let bend = (::naga_rust_rt::Scalar(-0.01719428412616253f64) + (t_8 * (::naga_rust_rt::Scalar(0.010519149713218212f64) - (t_8 * ::naga_rust_rt::Scalar(0.004035674501210451f64)))));
    let rest_2 = (::naga_rust_rt::Scalar(-0.0011748610995709896f64) + (t_8 * ::naga_rust_rt::Scalar(0.00045987413614057004f64)));
    let front_1 = (level + (d * (slope + (d * (bend + (d * (rest_2 - (d * ::naga_rust_rt::Scalar(0.0004454147710930556f64)))))))));
    let _e49 = v_phi_one_unit(t_8);
    return <::naga_rust_rt::Vec2<f64>>::from_scalars((t_8 * _e49), front_1);
}
pub fn dawson_near(x_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_dawson_near(::naga_rust_rt::into(x_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_dawson_near(x_1: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    let y = (x_1 * x_1);
    let p_2 = (::naga_rust_rt::Scalar(1.0000001192092896f64) + (y * (::naga_rust_rt::Scalar(-0.03806586563587189f64) + (y * (::naga_rust_rt::Scalar(0.03287903964519501f64) + (y * (::naga_rust_rt::Scalar(0.0011937979143112898f64) + (y * ::naga_rust_rt::Scalar(0.0001802321639843285f64)))))))));
    let q_1 = (::naga_rust_rt::Scalar(1f64) + (y * (::naga_rust_rt::Scalar(0.6286070346832275f64) + (y * (::naga_rust_rt::Scalar(0.18524527549743652f64) + (y * (::naga_rust_rt::Scalar(0.03334708884358406f64) + (y * (::naga_rust_rt::Scalar(0.0038517736829817295f64) + (y * ::naga_rust_rt::Scalar(0.00032483585528098047f64)))))))))));
    return ((x_1 * p_2) / q_1);
}
pub fn dawson_far(x_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_dawson_far(::naga_rust_rt::into(x_2)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_dawson_far(x_2: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    let y_1 = (::naga_rust_rt::Scalar(1f64) / (x_2 * x_2));
    let p_3 = (::naga_rust_rt::Scalar(1.0000001192092896f64) + (y_1 * (::naga_rust_rt::Scalar(0.49982157349586487f64) + (y_1 * (::naga_rust_rt::Scalar(0.7885714173316956f64) + (y_1 * (::naga_rust_rt::Scalar(-1.2632287740707397f64) + (y_1 * (::naga_rust_rt::Scalar(129.1666717529297f64) + (y_1 * (::naga_rust_rt::Scalar(-2472.171142578125f64) + (y_1 * (::naga_rust_rt::Scalar(26553.970703125f64) + (y_1 * (::naga_rust_rt::Scalar(-126146.453125f64) + (y_1 * ::naga_rust_rt::Scalar(201245.734375f64)))))))))))))))));
    return ((::naga_rust_rt::Scalar(0.5f64) * p_3) / x_2);
}
pub fn dawson(x_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_dawson(::naga_rust_rt::into(x_3)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_dawson(x_3: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    if ::naga_rust_rt::Scalar::into_branch_condition(x_3.elementwise_lt(::naga_rust_rt::Scalar(3f64))) {
        let _e3 = v_dawson_near(x_3);
        return _e3;
    }
    let _e4 = v_dawson_far(x_3);
    return _e4;
}
pub fn psi_thin(
    a_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    b_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_psi_thin(::naga_rust_rt::into(a_1), ::naga_rust_rt::into(b_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_psi_thin(
    a_1: ::naga_rust_rt::Scalar<f64>,
    b_1: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let slope_1 = (::naga_rust_rt::Scalar(0.5f64) * (b_1 - a_1));
    let _e10 = v_attenuation((::naga_rust_rt::Scalar(0.046910077030668f64) * (a_1 + (::naga_rust_rt::Scalar(0.046910077030668f64) * slope_1))));
    let _e16 = v_attenuation((::naga_rust_rt::Scalar(0.953089922969332f64) * (a_1 + (::naga_rust_rt::Scalar(0.953089922969332f64) * slope_1))));
    let _e25 = v_attenuation((::naga_rust_rt::Scalar(0.2307653449471585f64) * (a_1 + (::naga_rust_rt::Scalar(0.2307653449471585f64) * slope_1))));
    let _e31 = v_attenuation((::naga_rust_rt::Scalar(0.7692346550528415f64) * (a_1 + (::naga_rust_rt::Scalar(0.7692346550528415f64) * slope_1))));
    let _e41 = v_attenuation((::naga_rust_rt::Scalar(0.5f64) * (a_1 + (::naga_rust_rt::Scalar(0.5f64) * slope_1))));
    return (((::naga_rust_rt::Scalar(0.1184634425280945f64) * (_e10 + _e16)) + (::naga_rust_rt::Scalar(0.2393143352496832f64) * (_e25 + _e31))) + (::naga_rust_rt::Scalar(0.2844444444444444f64) * _e41));
}
pub fn psi(
    a_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    b_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_psi(::naga_rust_rt::into(a_2), ::naga_rust_rt::into(b_2)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_psi(
    a_2: ::naga_rust_rt::Scalar<f64>,
    b_2: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    if ::naga_rust_rt::Scalar::into_branch_condition((a_2 + b_2).elementwise_lt(::naga_rust_rt::Scalar(3f64))) {
        let _e5 = v_psi_thin(a_2, b_2);
        return _e5;
    }
    let root = (::naga_rust_rt::Scalar(2f64) * (b_2 - a_2).abs().max((::naga_rust_rt::Scalar(0.000001f64) * (a_2 + b_2)))).sqrt();
    let p_4 = (a_2 / root);
    let r = (b_2 / root);
    let _e20 = v_attenuation((::naga_rust_rt::Scalar(0.5f64) * (a_2 + b_2)));
    if ::naga_rust_rt::Scalar::into_branch_condition(b_2.elementwise_ge(a_2)) {
        let _e22 = v_erfcx(p_4);
        let _e23 = v_erfcx(r);
        return ((::naga_rust_rt::Scalar(1.7724538509055159f64) * (_e22 - (_e20 * _e23))) / root);
    }
    let _e29 = v_dawson(p_4);
    let _e30 = v_dawson(r);
    return ((::naga_rust_rt::Scalar(2f64) * (_e29 - (_e20 * _e30))) / root);
}
pub fn parts_node(
    a_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    b_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    h: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
    x_4: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    weight: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> ::naga_rust_rt::Vec2<f64> {
    ::naga_rust_rt::into(v_parts_node(::naga_rust_rt::into(a_3), ::naga_rust_rt::into(b_3), ::naga_rust_rt::into(h), ::naga_rust_rt::into(x_4), ::naga_rust_rt::into(weight)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_parts_node(
    a_3: ::naga_rust_rt::Scalar<f64>,
    b_3: ::naga_rust_rt::Scalar<f64>,
    h: ::naga_rust_rt::Vec2<f64>,
    x_4: ::naga_rust_rt::Scalar<f64>,
    weight: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Vec2<f64> {
    let y_2 = (::naga_rust_rt::Scalar(1f64) - x_4);
    let _e19 = v_attenuation((x_4 * (a_3 + ((::naga_rust_rt::Scalar(0.5f64) * x_4) * (b_3 - a_3)))));
    let value = ((weight * ((y_2 * h.x()) + (x_4 * h.y()))) * _e19);
    return <::naga_rust_rt::Vec2<f64>>::from_scalars((y_2 * value), (x_4 * value));
}
pub fn parts_thin(
    a_4: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    b_4: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    h_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
) -> ::naga_rust_rt::Vec2<f64> {
    ::naga_rust_rt::into(v_parts_thin(::naga_rust_rt::into(a_4), ::naga_rust_rt::into(b_4), ::naga_rust_rt::into(h_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_parts_thin(
    a_4: ::naga_rust_rt::Scalar<f64>,
    b_4: ::naga_rust_rt::Scalar<f64>,
    h_1: ::naga_rust_rt::Vec2<f64>,
) -> ::naga_rust_rt::Vec2<f64> {
    let _e5 = v_parts_node(a_4, b_4, h_1, ::naga_rust_rt::Scalar(0.033765242898424f64), ::naga_rust_rt::Scalar(0.0856622461895852f64));
    let _e8 = v_parts_node(a_4, b_4, h_1, ::naga_rust_rt::Scalar(0.1693953067668677f64), ::naga_rust_rt::Scalar(0.1803807865240693f64));
    let _e12 = v_parts_node(a_4, b_4, h_1, ::naga_rust_rt::Scalar(0.3806904069584015f64), ::naga_rust_rt::Scalar(0.2339569672863455f64));
    let _e16 = v_parts_node(a_4, b_4, h_1, ::naga_rust_rt::Scalar(0.6193095930415985f64), ::naga_rust_rt::Scalar(0.2339569672863455f64));
    let _e20 = v_parts_node(a_4, b_4, h_1, ::naga_rust_rt::Scalar(0.8306046932331324f64), ::naga_rust_rt::Scalar(0.1803807865240693f64));
    let _e24 = v_parts_node(a_4, b_4, h_1, ::naga_rust_rt::Scalar(0.966234757101576f64), ::naga_rust_rt::Scalar(0.0856622461895852f64));
    return (((((_e5 + _e8) + _e12) + _e16) + _e20) + _e24);
}
pub fn color_weights(
    a_5: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    b_5: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> ::naga_rust_rt::Vec2<f64> {
    ::naga_rust_rt::into(v_color_weights(::naga_rust_rt::into(a_5), ::naga_rust_rt::into(b_5)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_color_weights(
    a_5: ::naga_rust_rt::Scalar<f64>,
    b_5: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Vec2<f64> {
    if ::naga_rust_rt::Scalar::into_branch_condition((a_5 + b_5).elementwise_lt(::naga_rust_rt::Scalar(4f64))) {
        let _e6 = v_parts_thin(a_5, b_5, <::naga_rust_rt::Vec2<f64>>::from_scalars(a_5, b_5));
        return _e6;
    }
    let _e7 = v_psi(a_5, b_5);
    let _e13 = v_attenuation((::naga_rust_rt::Scalar(0.5f64) * (a_5 + b_5)));
    return <::naga_rust_rt::Vec2<f64>>::from_scalars((::naga_rust_rt::Scalar(1f64) - _e7), (_e7 - _e13));
}
pub fn emission_weights_level(
    mean: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    half_change: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    rest: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> ::naga_rust_rt::Vec2<f64> {
    ::naga_rust_rt::into(v_emission_weights_level(::naga_rust_rt::into(mean), ::naga_rust_rt::into(half_change), ::naga_rust_rt::into(rest)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_emission_weights_level(
    mean: ::naga_rust_rt::Scalar<f64>,
    half_change: ::naga_rust_rt::Scalar<f64>,
    rest: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Vec2<f64> {
    let inverse = (::naga_rust_rt::Scalar(1f64) / mean);
    let i_zero = ((::naga_rust_rt::Scalar(1f64) - rest) * inverse);
    let i_one = ((i_zero - rest) * inverse);
    let i_two = (((::naga_rust_rt::Scalar(2f64) * i_one) - rest) * inverse);
    let i_three = (((::naga_rust_rt::Scalar(3f64) * i_two) - rest) * inverse);
    let i_four = (((::naga_rust_rt::Scalar(4f64) * i_three) - rest) * inverse);
    let i_five = (((::naga_rust_rt::Scalar(5f64) * i_four) - rest) * inverse);
    let half_square = ((::naga_rust_rt::Scalar(0.5f64) * half_change) * half_change);
    let all = ((i_zero + (half_change * (i_one - i_two))) + (half_square * ((i_two - (::naga_rust_rt::Scalar(2f64) * i_three)) + i_four)));
    let back_1 = ((i_one + (half_change * (i_two - i_three))) + (half_square * ((i_three - (::naga_rust_rt::Scalar(2f64) * i_four)) + i_five)));
    return <::naga_rust_rt::Vec2<f64>>::from_scalars((all - back_1).max(::naga_rust_rt::Scalar(0f64)), back_1.max(::naga_rust_rt::Scalar(0f64)));
}
pub fn emission_weights(
    a_6: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    b_6: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> ::naga_rust_rt::Vec2<f64> {
    ::naga_rust_rt::into(v_emission_weights(::naga_rust_rt::into(a_6), ::naga_rust_rt::into(b_6)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_emission_weights(
    a_6: ::naga_rust_rt::Scalar<f64>,
    b_6: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Vec2<f64> {
    let sum_1 = (a_6 + b_6);
    if ::naga_rust_rt::Scalar::into_branch_condition(sum_1.elementwise_lt(::naga_rust_rt::Scalar(4f64))) {
        let _e8 = v_parts_thin(a_6, b_6, <::naga_rust_rt::Vec2<f64>>::from_scalars(::naga_rust_rt::Scalar(1f64), ::naga_rust_rt::Scalar(1f64)));
        return _e8;
    }
    let change = (b_6 - a_6);
    let _e12 = v_attenuation((::naga_rust_rt::Scalar(0.5f64) * sum_1));
    if ::naga_rust_rt::Scalar::into_branch_condition(change.abs().elementwise_lt((::naga_rust_rt::Scalar(0.015f64) * sum_1).max(::naga_rust_rt::Scalar(0.15f64)))) {
        let _e23 = v_emission_weights_level((::naga_rust_rt::Scalar(0.5f64) * sum_1), (::naga_rust_rt::Scalar(0.5f64) * change), _e12);
        return _e23;
    }
    let _e24 = v_psi(a_6, b_6);
    let back_2 = (((::naga_rust_rt::Scalar(1f64) - _e12) - (a_6 * _e24)) / change).max(::naga_rust_rt::Scalar(0f64));
    return <::naga_rust_rt::Vec2<f64>>::from_scalars((_e24 - back_2).max(::naga_rust_rt::Scalar(0f64)), back_2);
}
pub fn linear_product_mean(
    f: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
    g: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_linear_product_mean(::naga_rust_rt::into(f), ::naga_rust_rt::into(g)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_linear_product_mean(
    f: ::naga_rust_rt::Vec2<f64>,
    g: ::naga_rust_rt::Vec2<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    return ((((f.x() * g.x()) + (f.y() * g.y())) / ::naga_rust_rt::Scalar(3f64)) + (((f.x() * g.y()) + (f.y() * g.x())) / ::naga_rust_rt::Scalar(6f64)));
}
pub fn line_at(
    piece: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec4<f64>>,
    u: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_line_at(::naga_rust_rt::into(piece), ::naga_rust_rt::into(u)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_line_at(
    piece: ::naga_rust_rt::Vec4<f64>,
    u: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let part = ((u - piece.x()) / (piece.z() - piece.x()).max(::naga_rust_rt::Scalar(0.000000000000000000000000000001f64))).clamp(::naga_rust_rt::Scalar(0f64), ::naga_rust_rt::Scalar(1f64));
    return (piece.y() + (part * (piece.w() - piece.y())));
}
pub fn power(
    x_5: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    p: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_power(::naga_rust_rt::into(x_5), ::naga_rust_rt::into(p)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_power(
    x_5: ::naga_rust_rt::Scalar<f64>,
    p: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let mut logarithm: ::naga_rust_rt::Scalar<f64>;

    if ::naga_rust_rt::Scalar::into_branch_condition((!x_5.elementwise_gt(::naga_rust_rt::Scalar(0.000000000000000000000000000001f64)))) {
        return ::naga_rust_rt::Scalar(0f64);
    }
    logarithm = x_5.log2();
    if ::naga_rust_rt::Scalar::into_branch_condition(x_5.elementwise_gt(::naga_rust_rt::Scalar(0.7f64))) {
        let u_2 = ((x_5 - ::naga_rust_rt::Scalar(1f64)) / (x_5 + ::naga_rust_rt::Scalar(1f64)));
        let q_2 = (u_2 * u_2);
        logarithm = ((::naga_rust_rt::Scalar(2.8853900817779268f64) * u_2) * (::naga_rust_rt::Scalar(1f64) + (q_2 * (::naga_rust_rt::Scalar(0.3333333333333333f64) + (q_2 * (::naga_rust_rt::Scalar(0.2f64) + (q_2 * (::naga_rust_rt::Scalar(0.14285714285714285f64) + (q_2 * ::naga_rust_rt::Scalar(0.1111111111111111f64))))))))));
    }
    let _e32 = logarithm;
    return (p * _e32).max(::naga_rust_rt::Scalar(-125f64)).exp2();
}
pub fn fade(gradient: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec3<f64>>) -> f64 {
    ::naga_rust_rt::into(v_fade(::naga_rust_rt::into(gradient)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_fade(gradient: ::naga_rust_rt::Vec3<f64>) -> ::naga_rust_rt::Scalar<f64> {
    let squared = gradient.dot(gradient);
    return (squared / (squared + ::naga_rust_rt::Scalar(0.000001f64)));
}
pub fn normal_of(gradient_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec3<f64>>) -> ::naga_rust_rt::Vec3<f64> {
    ::naga_rust_rt::into(v_normal_of(::naga_rust_rt::into(gradient_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_normal_of(gradient_1: ::naga_rust_rt::Vec3<f64>) -> ::naga_rust_rt::Vec3<f64> {
    return (gradient_1 / ::naga_rust_rt::Vec3::splat_from_scalar(gradient_1.length().max(::naga_rust_rt::Scalar(0.000000000000000001f64))));
}
pub fn lit(
    gradient_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec3<f64>>,
    ray: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
    light: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec4<f64>>,
    material: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec3<f64>>,
) -> ::naga_rust_rt::Vec2<f64> {
    ::naga_rust_rt::into(v_lit(::naga_rust_rt::into(gradient_2), ::naga_rust_rt::into(ray), ::naga_rust_rt::into(light), ::naga_rust_rt::into(material)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_lit(
    gradient_2: ::naga_rust_rt::Vec3<f64>,
    ray: ::naga_rust_rt::Vec2<f64>,
    light: ::naga_rust_rt::Vec4<f64>,
    material: ::naga_rust_rt::Vec3<f64>,
) -> ::naga_rust_rt::Vec2<f64> {
    let _e4 = v_fade(gradient_2);
    let _e5 = v_normal_of(gradient_2);
    let half_way = (light.xyz() - <::naga_rust_rt::Vec3<f64>>::new_21(ray, ::naga_rust_rt::Scalar(1f64)).normalize());
    let glance = (_e5.dot(half_way).abs() / <::naga_rust_rt::Vec4<f64>>::new_31(half_way, ::naga_rust_rt::Scalar(0.001f64)).length());
    let brightness = (light.w() + (material.x() * _e5.dot(light.xyz()).abs()));
    let _e34 = v_power(glance.min(::naga_rust_rt::Scalar(1f64)), material.z());
    return <::naga_rust_rt::Vec2<f64>>::from_scalars((::naga_rust_rt::Scalar(1f64) + (_e4 * (brightness - ::naga_rust_rt::Scalar(1f64)))), ((_e4 * material.y()) * _e34));
}
pub fn outlined(
    gradient_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec3<f64>>,
    ray_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
    exponent: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    strength: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_outlined(::naga_rust_rt::into(gradient_3), ::naga_rust_rt::into(ray_1), ::naga_rust_rt::into(exponent), ::naga_rust_rt::into(strength)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_outlined(
    gradient_3: ::naga_rust_rt::Vec3<f64>,
    ray_1: ::naga_rust_rt::Vec2<f64>,
    exponent: ::naga_rust_rt::Scalar<f64>,
    strength: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let _e4 = v_normal_of(gradient_3);
    let direction = <::naga_rust_rt::Vec3<f64>>::new_21(ray_1, ::naga_rust_rt::Scalar(1f64)).normalize();
    let sine = _e4.cross(direction);
    let turned_away = (sine.dot(sine) / (::naga_rust_rt::Scalar(1f64) + _e4.dot(direction).abs()));
    let _e15 = v_fade(gradient_3);
    let _e19 = v_power(turned_away.min(::naga_rust_rt::Scalar(1f64)), exponent);
    return (::naga_rust_rt::Scalar(1f64) + ((_e15 * strength) * (_e19 - ::naga_rust_rt::Scalar(1f64))));
}
pub fn quarter_sine(x_6: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_quarter_sine(::naga_rust_rt::into(x_6)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_quarter_sine(x_6: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    let y_3 = (x_6 * x_6);
    return (x_6 * (::naga_rust_rt::Scalar(1.5707963705062866f64) + (y_3 * (::naga_rust_rt::Scalar(-0.645963728427887f64) + (y_3 * (::naga_rust_rt::Scalar(0.07968968152999878f64) + (y_3 * (::naga_rust_rt::Scalar(-0.004673766437917948f64) + (y_3 * ::naga_rust_rt::Scalar(0.00015148513193707913f64))))))))));
}
pub fn sine_of_turns(t_4: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_sine_of_turns(::naga_rust_rt::into(t_4)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_sine_of_turns(t_4: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    let r_1 = (t_4 - (t_4 + ::naga_rust_rt::Scalar(0.5f64)).floor());
    let folded = ((::naga_rust_rt::Scalar(0.5f64) * r_1.sign()) - r_1);
    let _e15 = v_quarter_sine((::naga_rust_rt::Scalar(4f64) * r_1.select(folded, r_1.abs().elementwise_gt(::naga_rust_rt::Scalar(0.25f64)))));
    return _e15;
}
pub fn cosine_of_turns(t_5: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_cosine_of_turns(::naga_rust_rt::into(t_5)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_cosine_of_turns(t_5: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    let r_2 = (t_5 - (t_5 + ::naga_rust_rt::Scalar(0.5f64)).floor());
    let _e10 = v_quarter_sine((::naga_rust_rt::Scalar(1f64) - (::naga_rust_rt::Scalar(4f64) * r_2.abs())));
    return _e10;
}
pub fn sinc_complement(x_7: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_sinc_complement(::naga_rust_rt::into(x_7)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_sinc_complement(x_7: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    let h_2 = (::naga_rust_rt::Scalar(3.141592653589793f64) * x_7);
    let y_4 = (h_2 * h_2);
    if ::naga_rust_rt::Scalar::into_branch_condition(y_4.elementwise_lt(::naga_rust_rt::Scalar(2.25f64))) {
        return (y_4 * (::naga_rust_rt::Scalar(0.1666666716337204f64) + (y_4 * (::naga_rust_rt::Scalar(-0.008333330042660236f64) + (y_4 * (::naga_rust_rt::Scalar(0.00019840399909298867f64) + (y_4 * (::naga_rust_rt::Scalar(-0.0000027487419629323995f64) + (y_4 * ::naga_rust_rt::Scalar(0.0000000229902035187024f64))))))))));
    }
    let _e22 = v_sine_of_turns((::naga_rust_rt::Scalar(0.5f64) * x_7));
    return (::naga_rust_rt::Scalar(1f64) - (_e22 / h_2));
}
pub fn bessel_one(x_8: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_bessel_one(::naga_rust_rt::into(x_8)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_bessel_one(x_8: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    let h_3 = (::naga_rust_rt::Scalar(3.141592653589793f64) * x_8);
    let y_5 = (h_3 * h_3);
    if ::naga_rust_rt::Scalar::into_branch_condition(y_5.elementwise_lt(::naga_rust_rt::Scalar(2.25f64))) {
        return (h_3 * (::naga_rust_rt::Scalar(0.3333333333333333f64) + (y_5 * (::naga_rust_rt::Scalar(-0.03333333333333333f64) + (y_5 * (::naga_rust_rt::Scalar(0.0011904761904761906f64) + (y_5 * (::naga_rust_rt::Scalar(-0.000022045855379188714f64) + (y_5 * (::naga_rust_rt::Scalar(0.0000002505210838544172f64) - (y_5 * ::naga_rust_rt::Scalar(0.0000000019270852604185937f64))))))))))));
    }
    let _e25 = v_sine_of_turns((::naga_rust_rt::Scalar(0.5f64) * x_8));
    let _e28 = v_cosine_of_turns((::naga_rust_rt::Scalar(0.5f64) * x_8));
    return ((_e25 - (h_3 * _e28)) / y_5);
}
pub fn strength_position(t_6: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_strength_position(::naga_rust_rt::into(t_6)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_strength_position(t_6: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    return ((::naga_rust_rt::Scalar(1f64) + t_6).log2() * ::naga_rust_rt::Scalar(0.1003288150616121f64)).clamp(::naga_rust_rt::Scalar(0f64), ::naga_rust_rt::Scalar(1f64));
}
pub fn psi_position(t_7: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_psi_position(::naga_rust_rt::into(t_7)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_psi_position(t_7: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    return (::naga_rust_rt::Scalar(1f64) - (::naga_rust_rt::Scalar(-0.25f64) * (::naga_rust_rt::Scalar(1f64) + t_7).log2()).exp2());
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
    let t_9 = (from_edge - ::naga_rust_rt::Scalar(1f64)).select(from_edge, at_edge);
    let before = (t_9 * (::naga_rust_rt::Scalar(-0.5f64) + (t_9 * (::naga_rust_rt::Scalar(1f64) - (::naga_rust_rt::Scalar(0.5f64) * t_9)))));
    let begin = (::naga_rust_rt::Scalar(1f64) + ((t_9 * t_9) * ((::naga_rust_rt::Scalar(1.5f64) * t_9) - ::naga_rust_rt::Scalar(2.5f64))));
    let end = (t_9 * (::naga_rust_rt::Scalar(0.5f64) + (t_9 * (::naga_rust_rt::Scalar(2f64) - (::naga_rust_rt::Scalar(1.5f64) * t_9)))));
    let after = ((t_9 * t_9) * ((::naga_rust_rt::Scalar(0.5f64) * t_9) - ::naga_rust_rt::Scalar(0.5f64)));
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
    rest_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    period: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    depth_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_mean_transmittance_wave(::naga_rust_rt::into(span_1), ::naga_rust_rt::into(extent_3), ::naga_rust_rt::into(k), ::naga_rust_rt::into(rest_1), ::naga_rust_rt::into(period), ::naga_rust_rt::into(depth_2)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_mean_transmittance_wave(
    span_1: ::naga_rust_rt::Vec3<f64>,
    extent_3: ::naga_rust_rt::Scalar<f64>,
    k: ::naga_rust_rt::Vec3<f64>,
    rest_1: ::naga_rust_rt::Scalar<f64>,
    period: ::naga_rust_rt::Scalar<f64>,
    depth_2: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let _e9 = v_phi_one((span_1.z() * period));
    let _e11 = v_phi_one(period);
    let series = ((span_1.z() * _e9) / _e11);
    let _e14 = v_attenuation(rest_1);
    let _e19 = v_attenuation(depth_2);
    let seen = ((k.x() + ((_e14 * k.z()) * series)) - (_e19 * k.y()));
    return (seen / extent_3).clamp(::naga_rust_rt::Scalar(0f64), ::naga_rust_rt::Scalar(1f64));
}
pub fn cosine_mean(
    phases: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
    weights: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_cosine_mean(::naga_rust_rt::into(phases), ::naga_rust_rt::into(weights)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_cosine_mean(
    phases: ::naga_rust_rt::Vec2<f64>,
    weights: ::naga_rust_rt::Vec2<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let mut product: ::naga_rust_rt::Scalar<f64>;

    let width = (phases.y() - phases.x());
    let base = ((::naga_rust_rt::Scalar(0.5f64) * (phases.x() + phases.y())) + ::naga_rust_rt::Scalar(0.5f64)).floor();
    let middle = (::naga_rust_rt::Scalar(0.5f64) * ((phases.x() - base) + (phases.y() - base)));
    let _e20 = v_cosine_of_turns(middle);
    let _e21 = v_sinc_complement(width);
    let _e24 = v_sine_of_turns((::naga_rust_rt::Scalar(0.5f64) * middle));
    let mean_1 = (::naga_rust_rt::Scalar(0.5f64) * (::naga_rust_rt::Scalar(1f64) - (_e20 * (::naga_rust_rt::Scalar(1f64) - _e21)))).select(((_e24 * _e24) + ((::naga_rust_rt::Scalar(0.5f64) * _e20) * _e21)), _e20.elementwise_gt(::naga_rust_rt::Scalar(0f64)));
    let tilt_1 = (weights.y() - weights.x());
    product = ((::naga_rust_rt::Scalar(0.5f64) * (weights.x() + weights.y())) * mean_1);
    if ::naga_rust_rt::Scalar::into_branch_condition(tilt_1.elementwise_ne(::naga_rust_rt::Scalar(0f64))) {
        let _e52 = product;
        let _e55 = v_sine_of_turns(middle);
        let _e57 = v_bessel_one(width);
        product = (_e52 + (((::naga_rust_rt::Scalar(0.25f64) * tilt_1) * _e55) * _e57));
    }
    let _e60 = product;
    return _e60;
}
pub fn arch_part(
    near: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    far: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    near_weight: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    far_weight: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_arch_part(::naga_rust_rt::into(near), ::naga_rust_rt::into(far), ::naga_rust_rt::into(near_weight), ::naga_rust_rt::into(far_weight)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_arch_part(
    near: ::naga_rust_rt::Scalar<f64>,
    far: ::naga_rust_rt::Scalar<f64>,
    near_weight: ::naga_rust_rt::Scalar<f64>,
    far_weight: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let mut product_1: ::naga_rust_rt::Scalar<f64>;

    let middle_1 = (::naga_rust_rt::Scalar(0.5f64) * (near + far));
    let half_width = (::naga_rust_rt::Scalar(0.5f64) * (far - near));
    let tilt_2 = (far_weight - near_weight);
    let _e16 = v_sine_of_turns((::naga_rust_rt::Scalar(0.5f64) * middle_1));
    let _e18 = v_sinc_complement(half_width);
    product_1 = (((::naga_rust_rt::Scalar(0.5f64) * (near_weight + far_weight)) * _e16) * (::naga_rust_rt::Scalar(1f64) - _e18));
    if ::naga_rust_rt::Scalar::into_branch_condition(tilt_2.elementwise_ne(::naga_rust_rt::Scalar(0f64))) {
        let _e25 = product_1;
        let _e30 = v_cosine_of_turns((::naga_rust_rt::Scalar(0.5f64) * middle_1));
        let _e32 = v_bessel_one(half_width);
        product_1 = (_e25 + (((::naga_rust_rt::Scalar(0.5f64) * tilt_2) * _e30) * _e32));
    }
    let _e35 = product_1;
    return _e35;
}
pub fn arch_mean(
    phases_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
    weights_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
    alternate: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<bool>>,
) -> f64 {
    ::naga_rust_rt::into(v_arch_mean(::naga_rust_rt::into(phases_1), ::naga_rust_rt::into(weights_1), ::naga_rust_rt::into(alternate)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_arch_mean(
    phases_1: ::naga_rust_rt::Vec2<f64>,
    weights_1: ::naga_rust_rt::Vec2<f64>,
    alternate: ::naga_rust_rt::Scalar<bool>,
) -> ::naga_rust_rt::Scalar<f64> {
    let mut local_1: ::naga_rust_rt::Scalar<bool>;
    let mut sum: ::naga_rust_rt::Scalar<f64> = ::naga_rust_rt::Scalar(0f64);
    let mut local_2: ::naga_rust_rt::Scalar<bool>;
    let mut local_3: ::naga_rust_rt::Scalar<bool>;
    let mut count: ::naga_rust_rt::Scalar<f64>;
    let mut center: ::naga_rust_rt::Scalar<f64>;

    let rising = phases_1.y().elementwise_ge(phases_1.x());
    let low_2 = phases_1.x().min(phases_1.y());
    let high_2 = phases_1.x().max(phases_1.y());
    let w_low_1 = weights_1.y().select(weights_1.x(), rising);
    let w_high_1 = weights_1.x().select(weights_1.y(), rising);
    let first_1 = low_2.ceil();
    let last_1 = high_2.floor();
    let first_is_odd = (first_1 - (::naga_rust_rt::Scalar(2f64) * (::naga_rust_rt::Scalar(0.5f64) * first_1).floor())).elementwise_gt(::naga_rust_rt::Scalar(0.5f64));
    if ::naga_rust_rt::Scalar::into_branch_condition(first_1.elementwise_gt(last_1)) {
        if ::naga_rust_rt::Scalar::into_branch_condition(alternate) {
            local_1 = (!first_is_odd);
        } else {
            local_1 = ::naga_rust_rt::Scalar(false);
        }
        let _e33 = local_1;
        if ::naga_rust_rt::Scalar::into_branch_condition(_e33) {
            return ::naga_rust_rt::Scalar(0f64);
        }
        let from_last = (low_2 - last_1);
        let to_first = (first_1 - high_2);
        if ::naga_rust_rt::Scalar::into_branch_condition(from_last.elementwise_le(to_first)) {
            let _e39 = v_arch_part(from_last, (high_2 - last_1), w_low_1, w_high_1);
            return _e39;
        }
        let _e41 = v_arch_part(to_first, (first_1 - low_2), w_high_1, w_low_1);
        return _e41;
    }
    let left = (first_1 - low_2);
    let right = (high_2 - last_1);
    let width_1 = (high_2 - low_2).max(::naga_rust_rt::Scalar(0.000000000000000000000000000001f64));
    let tilt_3 = (w_high_1 - w_low_1);
    if ::naga_rust_rt::Scalar::into_branch_condition((!(!alternate))) {
        local_2 = first_is_odd;
    } else {
        local_2 = ::naga_rust_rt::Scalar(true);
    }
    let _e55 = local_2;
    if ::naga_rust_rt::Scalar::into_branch_condition(_e55) {
        let _e56 = sum;
        let _e61 = v_arch_part(::naga_rust_rt::Scalar(0f64), left, (w_low_1 + (tilt_3 * (left / width_1))), w_low_1);
        sum = (_e56 + (left * _e61));
    }
    let last_is_odd = (last_1 - (::naga_rust_rt::Scalar(2f64) * (::naga_rust_rt::Scalar(0.5f64) * last_1).floor())).elementwise_gt(::naga_rust_rt::Scalar(0.5f64));
    if ::naga_rust_rt::Scalar::into_branch_condition((!(!alternate))) {
        local_3 = (!last_is_odd);
    } else {
        local_3 = ::naga_rust_rt::Scalar(true);
    }
    let _e78 = local_3;
    if ::naga_rust_rt::Scalar::into_branch_condition(_e78) {
        let _e79 = sum;
        let _e84 = v_arch_part(::naga_rust_rt::Scalar(0f64), right, (w_high_1 - (tilt_3 * (right / width_1))), w_high_1);
        sum = (_e79 + (right * _e84));
    }
    count = (last_1 - first_1);
    center = (::naga_rust_rt::Scalar(0.5f64) * (first_1 + last_1));
    if ::naga_rust_rt::Scalar::into_branch_condition(alternate) {
        let start_2 = first_1.select((first_1 + ::naga_rust_rt::Scalar(1f64)), first_is_odd);
        count = (::naga_rust_rt::Scalar(0.5f64) * (last_1 - start_2)).ceil();
        let _e100 = count;
        center = ((start_2 + _e100) - ::naga_rust_rt::Scalar(0.5f64));
    }
    let _e104 = sum;
    let _e105 = count;
    let _e108 = center;
    sum = (_e104 + ((::naga_rust_rt::Scalar(0.6366197723675814f64) * _e105) * (w_low_1 + (tilt_3 * ((_e108 - low_2) / width_1)))));
    let _e115 = sum;
    return (_e115 / width_1);
}
pub fn triangle_slope(
    near_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    far_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    near_weight_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    far_weight_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    duty: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_triangle_slope(::naga_rust_rt::into(near_1), ::naga_rust_rt::into(far_1), ::naga_rust_rt::into(near_weight_1), ::naga_rust_rt::into(far_weight_1), ::naga_rust_rt::into(duty)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_triangle_slope(
    near_1: ::naga_rust_rt::Scalar<f64>,
    far_1: ::naga_rust_rt::Scalar<f64>,
    near_weight_1: ::naga_rust_rt::Scalar<f64>,
    far_weight_1: ::naga_rust_rt::Scalar<f64>,
    duty: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let mut local_4: ::naga_rust_rt::Scalar<bool>;

    let foot = (::naga_rust_rt::Scalar(0.5f64) * (::naga_rust_rt::Scalar(1f64) - duty));
    let half_duty = (::naga_rust_rt::Scalar(0.5f64) * duty);
    let e_near = (near_1 - foot).select((half_duty - (::naga_rust_rt::Scalar(0.5f64) - near_1)), near_1.elementwise_gt(::naga_rust_rt::Scalar(0.25f64)));
    let e_far = (far_1 - foot).select((half_duty - (::naga_rust_rt::Scalar(0.5f64) - far_1)), far_1.elementwise_gt(::naga_rust_rt::Scalar(0.25f64)));
    let width_2 = (far_1 - near_1);
    if ::naga_rust_rt::Scalar::into_branch_condition(e_far.elementwise_gt(::naga_rust_rt::Scalar(0f64))) {
        local_4 = width_2.elementwise_gt(::naga_rust_rt::Scalar(0f64));
    } else {
        local_4 = ::naga_rust_rt::Scalar(false);
    }
    let _e33 = local_4;
    if ::naga_rust_rt::Scalar::into_branch_condition((!_e33)) {
        return ::naga_rust_rt::Scalar(0f64);
    }
    let below = e_near.elementwise_lt(::naga_rust_rt::Scalar(0f64));
    let start_3 = e_near.max(::naga_rust_rt::Scalar(0f64));
    let part_1 = width_2.select(e_far.min(width_2), below);
    let w_start = near_weight_1.select((far_weight_1 - ((far_weight_1 - near_weight_1) * (part_1 / width_2))), below);
    let sum_2 = ((((w_start * start_3) + (far_weight_1 * e_far)) / ::naga_rust_rt::Scalar(3f64)) + (((w_start * e_far) + (far_weight_1 * start_3)) / ::naga_rust_rt::Scalar(6f64)));
    return ((part_1 * sum_2) / half_duty);
}
pub fn triangle_period(
    low: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    high: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    w_low: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    w_high: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    valley: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    duty_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_triangle_period(::naga_rust_rt::into(low), ::naga_rust_rt::into(high), ::naga_rust_rt::into(w_low), ::naga_rust_rt::into(w_high), ::naga_rust_rt::into(valley), ::naga_rust_rt::into(duty_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_triangle_period(
    low: ::naga_rust_rt::Scalar<f64>,
    high: ::naga_rust_rt::Scalar<f64>,
    w_low: ::naga_rust_rt::Scalar<f64>,
    w_high: ::naga_rust_rt::Scalar<f64>,
    valley: ::naga_rust_rt::Scalar<f64>,
    duty_1: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let next = (valley + ::naga_rust_rt::Scalar(1f64));
    let width_3 = (high - low).max(::naga_rust_rt::Scalar(0.000000000000000000000000000001f64));
    let tilt_4 = (w_high - w_low);
    let up_near = (low - valley).min(::naga_rust_rt::Scalar(0.5f64));
    let up_far = (high - valley).min(::naga_rust_rt::Scalar(0.5f64));
    let down_near = (next - high).min(::naga_rust_rt::Scalar(0.5f64));
    let down_far = (next - low).min(::naga_rust_rt::Scalar(0.5f64));
    let to_peak = ((up_far - up_near) / width_3).min(::naga_rust_rt::Scalar(1f64));
    let from_peak = ((down_far - down_near) / width_3).min(::naga_rust_rt::Scalar(1f64));
    let _e34 = v_triangle_slope(up_near, up_far, w_low, (w_low + (tilt_4 * to_peak)), duty_1);
    let _e37 = v_triangle_slope(down_near, down_far, w_high, (w_high - (tilt_4 * from_peak)), duty_1);
    return (_e34 + _e37);
}
pub fn triangle_at(
    phase: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    duty_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_triangle_at(::naga_rust_rt::into(phase), ::naga_rust_rt::into(duty_2)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_triangle_at(
    phase: ::naga_rust_rt::Scalar<f64>,
    duty_2: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let t_10 = (phase - (phase + ::naga_rust_rt::Scalar(0.5f64)).floor()).abs();
    let e = (t_10 - (::naga_rust_rt::Scalar(0.5f64) * (::naga_rust_rt::Scalar(1f64) - duty_2))).select(((::naga_rust_rt::Scalar(0.5f64) * duty_2) - (::naga_rust_rt::Scalar(0.5f64) - t_10)), t_10.elementwise_gt(::naga_rust_rt::Scalar(0.25f64)));
    return (e.max(::naga_rust_rt::Scalar(0f64)) / (::naga_rust_rt::Scalar(0.5f64) * duty_2));
}
pub fn triangle_mean(
    phases_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
    weights_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
    duty_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_triangle_mean(::naga_rust_rt::into(phases_2), ::naga_rust_rt::into(weights_2), ::naga_rust_rt::into(duty_3)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_triangle_mean(
    phases_2: ::naga_rust_rt::Vec2<f64>,
    weights_2: ::naga_rust_rt::Vec2<f64>,
    duty_3: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let rising_1 = phases_2.y().elementwise_ge(phases_2.x());
    let low_3 = phases_2.x().min(phases_2.y());
    let high_3 = phases_2.x().max(phases_2.y());
    let w_low_2 = weights_2.y().select(weights_2.x(), rising_1);
    let w_high_2 = weights_2.x().select(weights_2.y(), rising_1);
    let width_4 = (high_3 - low_3);
    if ::naga_rust_rt::Scalar::into_branch_condition((!width_4.elementwise_gt(::naga_rust_rt::Scalar(0.000000000000000000000000000001f64)))) {
        let _e25 = v_triangle_at(low_3, duty_3);
        return ((::naga_rust_rt::Scalar(0.5f64) * (w_low_2 + w_high_2)) * _e25);
    }
    let first_2 = low_3.ceil();
    let last_2 = high_3.floor();
    if ::naga_rust_rt::Scalar::into_branch_condition(first_2.elementwise_gt(last_2)) {
        let _e30 = v_triangle_period(low_3, high_3, w_low_2, w_high_2, last_2, duty_3);
        return (_e30 / width_4);
    }
    let tilt_5 = (w_high_2 - w_low_2);
    let w_first = (w_low_2 + (tilt_5 * ((first_2 - low_3) / width_4)));
    let w_last = (w_high_2 - (tilt_5 * ((high_3 - last_2) / width_4)));
    let whole = (((::naga_rust_rt::Scalar(0.25f64) * duty_3) * (last_2 - first_2)) * (w_first + w_last));
    let _e49 = v_triangle_period(low_3, first_2, w_low_2, w_first, (first_2 - ::naga_rust_rt::Scalar(1f64)), duty_3);
    let _e51 = v_triangle_period(last_2, high_3, w_last, w_high_2, last_2, duty_3);
    return (((_e49 + whole) + _e51) / width_4);
}
pub fn cosine_at(phase_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>) -> f64 {
    ::naga_rust_rt::into(v_cosine_at(::naga_rust_rt::into(phase_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_cosine_at(phase_1: ::naga_rust_rt::Scalar<f64>) -> ::naga_rust_rt::Scalar<f64> {
    let _e7 = v_sine_of_turns((::naga_rust_rt::Scalar(0.5f64) * (phase_1 - (phase_1 + ::naga_rust_rt::Scalar(0.5f64)).floor())));
    return (_e7 * _e7);
}
pub fn arch_at(
    phase_2: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    alternate_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<bool>>,
) -> f64 {
    ::naga_rust_rt::into(v_arch_at(::naga_rust_rt::into(phase_2), ::naga_rust_rt::into(alternate_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_arch_at(
    phase_2: ::naga_rust_rt::Scalar<f64>,
    alternate_1: ::naga_rust_rt::Scalar<bool>,
) -> ::naga_rust_rt::Scalar<f64> {
    let mut local_5: ::naga_rust_rt::Scalar<bool>;

    let index = phase_2.floor();
    if ::naga_rust_rt::Scalar::into_branch_condition(alternate_1) {
        local_5 = (index - (::naga_rust_rt::Scalar(2f64) * (::naga_rust_rt::Scalar(0.5f64) * index).floor())).elementwise_gt(::naga_rust_rt::Scalar(0.5f64));
    } else {
        local_5 = ::naga_rust_rt::Scalar(false);
    }
    let _e14 = local_5;
    if ::naga_rust_rt::Scalar::into_branch_condition(_e14) {
        return ::naga_rust_rt::Scalar(0f64);
    }
    let _e22 = v_sine_of_turns((::naga_rust_rt::Scalar(0.5f64) * (phase_2 - (phase_2 + ::naga_rust_rt::Scalar(0.5f64)).floor())));
    return _e22.abs();
}
pub fn gaussian_mean_short(
    v: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    extent_4: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    q: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    weight_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    tilt: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_gaussian_mean_short(::naga_rust_rt::into(v), ::naga_rust_rt::into(extent_4), ::naga_rust_rt::into(q), ::naga_rust_rt::into(weight_1), ::naga_rust_rt::into(tilt)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_gaussian_mean_short(
    v: ::naga_rust_rt::Scalar<f64>,
    extent_4: ::naga_rust_rt::Scalar<f64>,
    q: ::naga_rust_rt::Scalar<f64>,
    weight_1: ::naga_rust_rt::Scalar<f64>,
    tilt: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let mut product_2: ::naga_rust_rt::Scalar<f64>;

    let a_7 = (v + (extent_4 * ::naga_rust_rt::Scalar(0.046910077030668f64)));
    let b_7 = (v + (extent_4 * ::naga_rust_rt::Scalar(0.2307653449471585f64)));
    let c = (v + (extent_4 * ::naga_rust_rt::Scalar(0.5f64)));
    let d_1 = (v + (extent_4 * ::naga_rust_rt::Scalar(0.7692346550528415f64)));
    let e_1 = (v + (extent_4 * ::naga_rust_rt::Scalar(0.953089922969332f64)));
    let _e22 = v_attenuation(((a_7 * a_7) + q));
    let _e25 = v_attenuation(((b_7 * b_7) + q));
    let _e28 = v_attenuation(((d_1 * d_1) + q));
    let _e31 = v_attenuation(((e_1 * e_1) + q));
    let outer = (::naga_rust_rt::Scalar(0.1184634425280945f64) * (_e22 + _e31));
    let inner_1 = (::naga_rust_rt::Scalar(0.2393143352496832f64) * (_e25 + _e28));
    let _e41 = v_attenuation(((c * c) + q));
    let mean_2 = ((outer + inner_1) + (::naga_rust_rt::Scalar(0.2844444444444444f64) * _e41));
    product_2 = (weight_1 * mean_2);
    if ::naga_rust_rt::Scalar::into_branch_condition(tilt.elementwise_ne(::naga_rust_rt::Scalar(0f64))) {
        let _e49 = product_2;
        product_2 = (_e49 + (tilt * (((::naga_rust_rt::Scalar(0.5f64) * mean_2) + (::naga_rust_rt::Scalar(0.05367459204973622f64) * (_e31 - _e22))) + (::naga_rust_rt::Scalar(0.06443171250014852f64) * (_e28 - _e25)))));
    }
    let _e62 = product_2;
    return _e62;
}
pub fn gaussian_product_mean(
    p_front: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
    p_back: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
    weights_3: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_gaussian_product_mean(::naga_rust_rt::into(p_front), ::naga_rust_rt::into(p_back), ::naga_rust_rt::into(weights_3)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_gaussian_product_mean(
    p_front: ::naga_rust_rt::Vec2<f64>,
    p_back: ::naga_rust_rt::Vec2<f64>,
    weights_3: ::naga_rust_rt::Vec2<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let mut local_6: ::naga_rust_rt::Scalar<bool>;
    let mut product_3: ::naga_rust_rt::Scalar<f64>;

    let step = (p_back - p_front);
    let extent_5 = step.length();
    let along = <::naga_rust_rt::Vec2<f64>>::from_scalars(::naga_rust_rt::Scalar(1f64), ::naga_rust_rt::Scalar(0f64)).select((step / ::naga_rust_rt::Vec2::splat_from_scalar(extent_5.max(::naga_rust_rt::Scalar(0.000000000000000001f64)))), ::naga_rust_rt::Vec2::splat_from_scalar(extent_5.elementwise_gt(::naga_rust_rt::Scalar(0.000000000000000001f64))));
    let from_back = p_back.dot(p_back).elementwise_lt(p_front.dot(p_front));
    let near_end = p_front.select((-p_back), ::naga_rust_rt::Vec2::splat_from_scalar(from_back));
    let near_weight_2 = weights_3.x().select(weights_3.y(), from_back);
    let tilt_6 = (weights_3.y().select(weights_3.x(), from_back) - near_weight_2);
    let gen_v_start = near_end.dot(along);
    let across = ((near_end.x() * along.y()) - (near_end.y() * along.x()));
    let q_3 = (across * across);
    let gen_v_end = (gen_v_start + extent_5);
    if ::naga_rust_rt::Scalar::into_branch_condition(extent_5.elementwise_lt(::naga_rust_rt::Scalar(1f64))) {
        local_6 = (extent_5 * (gen_v_start + gen_v_end).abs()).elementwise_lt(::naga_rust_rt::Scalar(2f64));
    } else {
        local_6 = ::naga_rust_rt::Scalar(false);
    }
    let _e49 = local_6;
    if ::naga_rust_rt::Scalar::into_branch_condition(_e49) {
        let _e50 = v_gaussian_mean_short(gen_v_start, extent_5, q_3, near_weight_2, tilt_6);
        return _e50;
    }
    let a_8 = gen_v_start.abs().min(gen_v_end.abs());
    let b_8 = gen_v_start.abs().max(gen_v_end.abs());
    let _e59 = v_attenuation(((a_8 * a_8) + q_3));
    let _e62 = v_attenuation(((b_8 * b_8) + q_3));
    let _e63 = v_erfcx(a_8);
    let tail_a = (_e59 * _e63);
    let _e65 = v_erfcx(b_8);
    let tail_b = (_e62 * _e65);
    let same_side = (gen_v_start * gen_v_end).elementwise_gt(::naga_rust_rt::Scalar(0f64));
    let _e70 = v_attenuation(q_3);
    let area = (((::naga_rust_rt::Scalar(2f64) * _e70) - tail_a) - tail_b).select((tail_a - tail_b), same_side);
    let mean_3 = ((::naga_rust_rt::Scalar(0.886226925452758f64) * area) / extent_5);
    product_3 = (near_weight_2 * mean_3);
    if ::naga_rust_rt::Scalar::into_branch_condition(tilt_6.elementwise_ne(::naga_rust_rt::Scalar(0f64))) {
        let _e84 = product_3;
        product_3 = (_e84 + ((tilt_6 * (((::naga_rust_rt::Scalar(0.5f64) * (_e59 - _e62)) / extent_5) - (gen_v_start * mean_3)).max(::naga_rust_rt::Scalar(0f64))) / extent_5));
    }
    let _e96 = product_3;
    return _e96;
}
pub fn gaussian_mean(
    p_front_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
    p_back_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
) -> f64 {
    ::naga_rust_rt::into(v_gaussian_mean(::naga_rust_rt::into(p_front_1), ::naga_rust_rt::into(p_back_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_gaussian_mean(
    p_front_1: ::naga_rust_rt::Vec2<f64>,
    p_back_1: ::naga_rust_rt::Vec2<f64>,
) -> ::naga_rust_rt::Scalar<f64> {
    let _e5 = v_gaussian_product_mean(p_front_1, p_back_1, <::naga_rust_rt::Vec2<f64>>::from_scalars(::naga_rust_rt::Scalar(1f64), ::naga_rust_rt::Scalar(1f64)));
    return _e5;
}
pub fn clip_to_range(
    within: impl ::naga_rust_rt::Into<::naga_rust_rt::Vec2<f64>>,
    front: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    back: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    low_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
    high_1: impl ::naga_rust_rt::Into<::naga_rust_rt::Scalar<f64>>,
) -> ::naga_rust_rt::Vec2<f64> {
    ::naga_rust_rt::into(v_clip_to_range(::naga_rust_rt::into(within), ::naga_rust_rt::into(front), ::naga_rust_rt::into(back), ::naga_rust_rt::into(low_1), ::naga_rust_rt::into(high_1)))
}
#[allow(unused_parens, clippy::all, clippy::pedantic, clippy::nursery)]
fn v_clip_to_range(
    within: ::naga_rust_rt::Vec2<f64>,
    front: ::naga_rust_rt::Scalar<f64>,
    back: ::naga_rust_rt::Scalar<f64>,
    low_1: ::naga_rust_rt::Scalar<f64>,
    high_1: ::naga_rust_rt::Scalar<f64>,
) -> ::naga_rust_rt::Vec2<f64> {
    let mut local_7: ::naga_rust_rt::Scalar<bool>;

    let change_1 = (back - front);
    if ::naga_rust_rt::Scalar::into_branch_condition(change_1.abs().elementwise_lt(::naga_rust_rt::Scalar(0.000000000000000000000000000001f64))) {
        if ::naga_rust_rt::Scalar::into_branch_condition(front.elementwise_ge(low_1)) {
            local_7 = front.elementwise_le(high_1);
        } else {
            local_7 = ::naga_rust_rt::Scalar(false);
        }
        let _e14 = local_7;
        if ::naga_rust_rt::Scalar::into_branch_condition(_e14) {
            return within;
        }
        return <::naga_rust_rt::Vec2<f64>>::from_scalars(::naga_rust_rt::Scalar(1f64), ::naga_rust_rt::Scalar(0f64));
    }
    let x_low = ((low_1 - front) / change_1);
    let x_high = ((high_1 - front) / change_1);
    return <::naga_rust_rt::Vec2<f64>>::from_scalars(within.x().max(x_low.min(x_high)), within.y().min(x_low.max(x_high)));
}
}
