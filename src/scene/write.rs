//! A scene as the text of a scene file.

use std::fmt::Write as _;

use super::choice::{CameraChoice, Draft, Opening, Scene, Units, Viewpoint};
use super::optics::{EmissionModel, LightSpace, SilhouetteMode};
use super::shape::{SinusoidVariant, WidgetShape};
use super::transfer::TransferFunction;
use super::widget::Widget;

impl Scene {
    /// The text of a scene file that [`Scene::parse`] reads as this scene: numbers keep their digits, but angles and the
    /// lengths of directions, which are written in the file's units and may differ by the last one.
    pub fn to_toml(&self) -> String {
        let mut text = String::new();
        let mut line = |args: std::fmt::Arguments<'_>| {
            // Writing to a string does not fail.
            let _ = text.write_fmt(args);
            text.push('\n');
        };
        line(format_args!("[image]\nwidth = {}\nheight = {}", self.size[0], self.size[1]));
        line(format_args!("background = {:?}", self.background));
        if let Some(field) = &self.field {
            line(format_args!("\n[field]\nscalar = {}", toml::Value::from(field.as_str())));
        }
        line(format_args!("\n{}", camera(&self.camera)));
        if let Some(clip) = &self.clip {
            line(format_args!("\n[clip]\nmin = {:?}\nmax = {:?}", clip.min.to_array(), clip.max.to_array()));
        }
        if let Some(lighting) = &self.optics.lighting {
            let space = match lighting.space {
                LightSpace::View => "view",
                LightSpace::World => "world",
            };
            line(format_args!("\n[lighting]\ndirection = {:?}\nspace = \"{space}\"", lighting.direction.to_array()));
            line(format_args!("ambient = {:?}\ndiffuse = {:?}", lighting.ambient, lighting.diffuse));
            line(format_args!("specular = {:?}\nshininess = {:?}", lighting.specular, lighting.shininess));
        }
        if let Some(silhouette) = &self.optics.silhouette {
            let mode = match silhouette.mode {
                SilhouetteMode::Opacity => "opacity",
                SilhouetteMode::Depth => "depth",
            };
            line(format_args!("\n[silhouette]\nexponent = {:?}", silhouette.exponent));
            line(format_args!("strength = {:?}\nmode = \"{mode}\"", silhouette.strength));
        }
        let unweighted = self.optics.emission == EmissionModel::Unweighted;
        if self.transfer.is_some() || unweighted {
            line(format_args!("\n[transfer]"));
        }
        if unweighted {
            line(format_args!("emission = \"unweighted\""));
        }
        if let Some(choice) = &self.transfer {
            let units = match choice.units {
                Units::Data => "data",
                Units::Normalized => "normalized",
            };
            line(format_args!("units = \"{units}\""));
            let draft = choice.draft.clone().unwrap_or_else(|| match &choice.function {
                TransferFunction::Widgets(widgets) => {
                    Draft { widgets: widgets.iter().map(|widget| (widget.clone(), false)).collect(), curve: None }
                }
                TransferFunction::Curve(curve) => Draft { widgets: Vec::new(), curve: Some(curve.clone()) },
            });
            if !draft.widgets.is_empty() && draft.curve.is_some() {
                let draws_curve = matches!(choice.function, TransferFunction::Curve(_));
                line(format_args!("draw = \"{}\"", if draws_curve { "curve" } else { "widgets" }));
            }
            for (each, is_hidden) in &draft.widgets {
                line(format_args!("\n[[transfer.widget]]\n{}", widget(each)));
                if *is_hidden {
                    line(format_args!("hidden = true"));
                }
            }
            if let Some(curve) = &draft.curve {
                line(format_args!("\n[transfer.curve]\n# scalar, red, green, blue (linear), extinction\npoints = ["));
                for node in &curve.nodes {
                    let [r, g, b] = node.color;
                    line(format_args!("    {:?},", [node.scalar, r, g, b, node.extinction]));
                }
                line(format_args!("]"));
            }
        }
        text
    }
}

fn camera(camera: &CameraChoice) -> String {
    let mut text = String::from("[camera]\n");
    match camera.viewpoint {
        Viewpoint::At { eye, target, up } => {
            let _ = writeln!(text, "eye = {:?}", eye.to_array());
            for (key, vector) in [("target", target), ("up", up)] {
                if let Some(vector) = vector {
                    let _ = writeln!(text, "{key} = {:?}", vector.to_array());
                }
            }
        }
        Viewpoint::Fit { azimuth, elevation, zoom } => {
            let (azimuth, elevation) = (azimuth.to_degrees(), elevation.to_degrees());
            let _ = writeln!(text, "azimuth = {azimuth:?}\nelevation = {elevation:?}\nzoom = {zoom:?}");
        }
    }
    let _ = match camera.opening {
        Opening::Perspective { fov_y } => writeln!(text, "fov_y = {:?}", fov_y.to_degrees()),
        Opening::Orthographic { height: Some(height) } => writeln!(text, "height = {height:?}"),
        Opening::Orthographic { height: None } => writeln!(text, "projection = \"orthographic\""),
    };
    if let Some(near) = camera.near {
        let _ = writeln!(text, "near = {near:?}");
    }
    text.truncate(text.trim_end().len());
    text
}

fn widget(widget: &Widget) -> String {
    let mut lines = match &widget.shape {
        WidgetShape::Uniform => vec!["shape = \"uniform\"".to_owned()],
        WidgetShape::Gaussian { center, sigma, angle } => {
            let angle = angle.to_degrees();
            vec!["shape = \"gaussian\"".into(), format!("center = {center:?}\nsigma = {sigma:?}\nangle = {angle:?}")]
        }
        &WidgetShape::Triangle { direction, offset, period, duty } => {
            let wave = wave("triangle", direction, offset, period);
            vec![wave, format!("duty = {duty:?}")]
        }
        &WidgetShape::Sinusoid { direction, offset, period, variant } => {
            let variant = match variant {
                SinusoidVariant::Cos => "cos",
                SinusoidVariant::Arch => "arch",
                SinusoidVariant::Half => "half",
            };
            vec![wave("sinusoid", direction, offset, period), format!("variant = \"{variant}\"")]
        }
        WidgetShape::Ramp { direction, knots } => vec!["shape = \"ramp\"".into(), knotted(*direction, knots, "\n")],
    };
    lines.push(format!("color = {:?}\nextinction = {:?}", widget.color, widget.extinction));
    for (key, range) in [("scalar_range", widget.scalar_range), ("gradient_range", widget.gradient_range)] {
        lines.extend(range.map(|range| format!("{key} = {range:?}")));
    }
    if let Some(window) = &widget.window {
        lines.push(format!("window = {{ {} }}", knotted(window.direction, &window.knots, ", ")));
    }
    lines.join("\n")
}

/// The file's directions have length 1, and what is measured along them is measured so.
fn unit(direction: [f64; 2]) -> ([f64; 2], f64) {
    let length = direction[0].hypot(direction[1]);
    if length == 1.0 { (direction, 1.0) } else { (direction.map(|v| v / length), length) }
}

fn wave(shape: &str, direction: [f64; 2], offset: f64, period: f64) -> String {
    let (direction, length) = unit(direction);
    let [offset, period] = [offset, period].map(|v| v / length);
    format!("shape = \"{shape}\"\ndirection = {direction:?}\noffset = {offset:?}\nperiod = {period:?}")
}

fn knotted(direction: [f64; 2], knots: &[[f64; 2]], between: &str) -> String {
    let (direction, length) = unit(direction);
    let knots: Vec<[f64; 2]> = knots.iter().map(|&[u, weight]| [u / length, weight]).collect();
    format!("direction = {direction:?}{between}knots = {knots:?}")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Everything that a file may hold.
    const TEXT: &str = r##"
        [image]
        width = 321
        height = 200
        background = "#10204080"
        [field]
        scalar = "a \"b\" \\ c"
        [camera]
        eye = [1e-3, -2.5, 3e8]
        target = [0.1, 0.2, 0.3]
        up = [0, 1, 0]
        fov_y = 50
        near = 0.125
        [clip]
        min = [-1e-3, 0, 0.1]
        max = [7, 1e9, 0.3]
        [lighting]
        direction = [0, 0, 4]
        space = "world"
        shininess = 9.5
        [silhouette]
        exponent = 1.5
        strength = 0.25
        mode = "depth"
        [transfer]
        emission = "unweighted"
        [[transfer.widget]]
        shape = "gaussian"
        center = [0.1, 1e-20]
        sigma = [0.3, 7]
        angle = 90
        color = [0.1, 0.2, 4]
        extinction = 1e30
        [[transfer.widget]]
        shape = "triangle"
        direction = [0, -4]
        offset = 0.3
        period = 0.7
        duty = 0.5
        color = [1, 1, 1]
        extinction = 0.1
        scalar_range = [-1, 2.5]
        [[transfer.widget]]
        shape = "sinusoid"
        period = 0.7
        variant = "half"
        color = [1, 1, 1]
        extinction = 0.1
        gradient_range = [0.5, 0.5]
        window = { direction = [0, 2], knots = [[0, 0], [1.5, 1]] }
        [[transfer.widget]]
        shape = "ramp"
        knots = [[0, 0.25], [1, 0.5]]
        color = [1, 1, 1]
        extinction = 0.1
        [[transfer.widget]]
        shape = "uniform"
        color = [0, 0, 0]
        extinction = 0
    "##;

    #[test]
    fn what_is_written_is_read() {
        let curve = "units = \"normalized\"\n[transfer.curve]\npoints = [[0, 1, 0, 0.5, 2], [1, 0, 0, 0, 0]]";
        let fitted = "[camera]\nazimuth = 90\nelevation = -45\nzoom = 1.5\nprojection = \"orthographic\"";
        let one = "[[transfer.widget]]\nshape = \"uniform\"\ncolor = [1, 1, 1]\nextinction = 2\nhidden = ";
        let points = "[transfer.curve]\npoints = [[0, 1, 0, 0.5, 2], [1, 0, 0, 0, 0]]";
        let hidden = format!("[transfer]\nunits = \"normalized\"\n{one}true\n{one}false");
        let both = format!("[transfer]\ndraw = \"curve\"\n{one}false\n{one}true\n{points}");
        let aside = format!("[transfer]\ndraw = \"widgets\"\n{one}true\n{points}");
        for text in [TEXT, curve, fitted, "[camera]\nheight = 3", "", &hidden, &both, &aside] {
            let scene = Scene::parse(text, &[]).unwrap();
            let written = scene.to_toml();
            let read = Scene::parse(&written, &[]).unwrap_or_else(|e| panic!("{e}:\n{written}"));
            // These angles and directions have exact degrees and lengths.
            assert_eq!(read, scene, "{written}");
            assert_eq!(read.to_toml(), written, "a scene has one text");
        }
    }

    #[test]
    fn directions_of_any_length_keep_their_waves() {
        let shape =
            WidgetShape::Sinusoid { direction: [3.0, -4.0], offset: 0.7, period: 2.0, variant: SinusoidVariant::Cos };
        let function = TransferFunction::Widgets(vec![Widget::new(shape.clone(), [1.0; 3], 1.0)]);
        let transfer = Some(super::super::TransferChoice { units: Units::Data, function, draft: None });
        let scene = Scene { transfer, ..Scene::parse("", &[]).unwrap() };
        let read = Scene::parse(&scene.to_toml(), &[]).unwrap().transfer.unwrap().function;
        let TransferFunction::Widgets(widgets) = read else { panic!("widgets stay widgets") };
        for [s, g] in [[0.1, 0.2], [5.0, -3.0]] {
            let error = (widgets[0].shape.profile(s, g) - shape.profile(s, g)).abs();
            assert!(error < 1e-12, "{error:e} at {s}, {g}");
        }
    }
}
