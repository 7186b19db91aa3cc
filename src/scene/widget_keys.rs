//! `[[transfer.widget]]` of a scene file: its keys, and what is wrong with them.

use serde::Deserialize;

use super::document::Problem;
use super::file::{Checked, Color, Numbers, check_extinction, finite};
use super::shape::{SinusoidVariant, WidgetShape, Window};
use super::widget::Widget;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WidgetKeys {
    shape: ShapeKey,
    center: Option<Numbers<2>>,
    sigma: Option<Numbers<2>>,
    angle: Option<f64>,
    direction: Option<Numbers<2>>,
    offset: Option<f64>,
    period: Option<f64>,
    duty: Option<f64>,
    variant: Option<VariantKey>,
    knots: Option<Vec<Numbers<2>>>,
    color: Color,
    extinction: f64,
    scalar_range: Option<Numbers<2>>,
    gradient_range: Option<Numbers<2>>,
    window: Option<WindowKeys>,
    #[serde(default)]
    pub(super) hidden: bool,
}

#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum ShapeKey {
    Uniform,
    Gaussian,
    Triangle,
    Sinusoid,
    Ramp,
}

#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum VariantKey {
    Cos,
    Arch,
    Half,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WindowKeys {
    direction: Option<Numbers<2>>,
    knots: Vec<Numbers<2>>,
}

/// The widget of these keys, the `index`-th from 0.
pub(super) fn check_widget(index: usize, keys: &WidgetKeys) -> Checked<Widget> {
    let key = |name: &str| format!("transfer.widget.{index}.{name}");
    let range = |name: &str, value: Option<Numbers<2>>| {
        let Some(Numbers([low, high])) = value else { return Ok(None) };
        finite(&key(name), &[low, high])?;
        if low > high {
            return Err(Problem::new(key(name), format!("the lower end comes first: [{high}, {low}]")));
        }
        Ok(Some([low, high]))
    };
    let window = |window: &WindowKeys| {
        Ok(Window {
            direction: direction(&key("window.direction"), window.direction)?,
            knots: knots(&key("window.knots"), &window.knots)?,
        })
    };
    Ok(Widget {
        shape: check_shape(keys, &key)?,
        color: keys.color.rgb(&key("color"))?,
        extinction: check_extinction(&key("extinction"), keys.extinction)?,
        scalar_range: range("scalar_range", keys.scalar_range)?,
        gradient_range: range("gradient_range", keys.gradient_range)?,
        window: keys.window.as_ref().map(window).transpose()?,
    })
}

fn check_shape(keys: &WidgetKeys, key: &impl Fn(&str) -> String) -> Checked<WidgetShape> {
    let (shape, own): (_, &[&str]) = match keys.shape {
        ShapeKey::Uniform => ("uniform", &[]),
        ShapeKey::Gaussian => ("gaussian", &["center", "sigma", "angle"]),
        ShapeKey::Triangle => ("triangle", &["direction", "offset", "period", "duty"]),
        ShapeKey::Sinusoid => ("sinusoid", &["direction", "offset", "period", "variant"]),
        ShapeKey::Ramp => ("ramp", &["direction", "knots"]),
    };
    let given = [
        ("center", keys.center.is_some()),
        ("sigma", keys.sigma.is_some()),
        ("angle", keys.angle.is_some()),
        ("direction", keys.direction.is_some()),
        ("offset", keys.offset.is_some()),
        ("period", keys.period.is_some()),
        ("duty", keys.duty.is_some()),
        ("variant", keys.variant.is_some()),
        ("knots", keys.knots.is_some()),
    ];
    if let Some((name, _)) = given.iter().find(|(name, given)| *given && !own.contains(name)) {
        let own = if own.is_empty() { "scalar_range and gradient_range".into() } else { own.join(", ") };
        return Err(Problem::new(key(name), format!("a {shape} widget has none: it has {own}")));
    }
    let needed = |name: &str| Problem::new(key(name), format!("a {shape} widget needs it"));
    Ok(match keys.shape {
        ShapeKey::Uniform => WidgetShape::Uniform,
        ShapeKey::Gaussian => {
            let center = keys.center.ok_or_else(|| needed("center"))?.0;
            let sigma = keys.sigma.ok_or_else(|| needed("sigma"))?.0;
            finite(&key("center"), &center)?;
            finite(&key("sigma"), &sigma)?;
            if sigma.iter().any(|s| *s <= 0.0) {
                return Err(Problem::new(key("sigma"), format!("both must be above 0, not {sigma:?}")));
            }
            finite(&key("angle"), keys.angle.as_slice())?;
            WidgetShape::Gaussian { center, sigma, angle: keys.angle.unwrap_or(0.0).to_radians() }
        }
        ShapeKey::Triangle | ShapeKey::Sinusoid => {
            let direction = direction(&key("direction"), keys.direction)?;
            finite(&key("offset"), keys.offset.as_slice())?;
            let offset = keys.offset.unwrap_or(0.0);
            let period = keys.period.ok_or_else(|| needed("period"))?;
            finite(&key("period"), &[period])?;
            if period <= 0.0 {
                return Err(Problem::new(key("period"), format!("must be above 0, not {period}")));
            }
            if let ShapeKey::Sinusoid = keys.shape {
                let variant = match keys.variant {
                    Some(VariantKey::Cos) | None => SinusoidVariant::Cos,
                    Some(VariantKey::Arch) => SinusoidVariant::Arch,
                    Some(VariantKey::Half) => SinusoidVariant::Half,
                };
                WidgetShape::Sinusoid { direction, offset, period, variant }
            } else {
                let duty = keys.duty.unwrap_or(1.0);
                if !(duty > 0.0 && duty <= 1.0) {
                    return Err(Problem::new(key("duty"), format!("must be above 0 and at most 1, not {duty}")));
                }
                WidgetShape::Triangle { direction, offset, period, duty }
            }
        }
        ShapeKey::Ramp => {
            let direction = direction(&key("direction"), keys.direction)?;
            let list = keys.knots.as_ref().ok_or_else(|| needed("knots"))?;
            WidgetShape::Ramp { direction, knots: knots(&key("knots"), list)? }
        }
    })
}

/// Of unit length; along the scalar where nothing is said.
fn direction(key: &str, given: Option<Numbers<2>>) -> Checked<[f64; 2]> {
    let Some(Numbers([s, g])) = given else { return Ok([1.0, 0.0]) };
    finite(key, &[s, g])?;
    // By the larger one first, so that no square leaves f64's range.
    let most = s.abs().max(g.abs());
    if most == 0.0 {
        return Err(Problem::new(
            key,
            "is zero and points nowhere: [1, 0] is the scalar, [0, 1] its gradient magnitude",
        ));
    }
    let (s, g) = (s / most, g / most);
    let length = s.hypot(g);
    Ok([s / length, g / length])
}

fn knots(key: &str, given: &[Numbers<2>]) -> Checked<Vec<[f64; 2]>> {
    if given.len() < 2 {
        return Err(Problem::new(key, format!("at least two knots [u, weight] are needed, not {}", given.len())));
    }
    let mut knots: Vec<[f64; 2]> = Vec::with_capacity(given.len());
    for (index, &Numbers([u, weight])) in given.iter().enumerate() {
        let key = format!("{key}.{index}");
        finite(&key, &[u, weight])?;
        if weight < 0.0 {
            return Err(Problem::new(key, format!("a weight must not be negative: {weight}")));
        }
        if let Some(before) = knots.last().filter(|before| before[0] >= u) {
            return Err(Problem::new(key, format!("knots must increase: {u} follows {}", before[0])));
        }
        knots.push([u, weight]);
    }
    Ok(knots)
}
