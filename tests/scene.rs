//! Scene files as users write them: what is read, what flags change, and how mistakes are named.

use tetralux::mesh::synth::Sample;
use tetralux::scene::{
    EmissionModel, LightSpace, Optics, Override, Scene, SilhouetteMode, SinusoidVariant, TransferFunction, Units,
    Viewpoint, Widget, WidgetShape, Window, boundaries, homogeneous_regions,
};
use tetralux::space::Interval;
use tetralux::tet::{FieldChoice, HexSplit, JointHistogram, TetMesh};

const GAUSSIAN: &str = "[[transfer.widget]]\nshape = \"gaussian\"\ncenter = [1, 2]\nsigma = [0.5, 1]\nangle = 90\n\
                        color = \"#ff8000\"\nextinction = 3\nscalar_range = [0, 2]\n";

fn set(key: &str, value: &str) -> Override {
    Override { key: key.into(), value: value.into(), origin: format!("--set {key}={value}") }
}

fn widgets(scene: &Scene) -> &[Widget] {
    match &scene.transfer.as_ref().unwrap().function {
        TransferFunction::Widgets(widgets) => widgets,
        TransferFunction::Curve(_) => panic!("widgets were given"),
    }
}

#[test]
fn nothing_said_is_a_scene() {
    let scene = Scene::parse("", &[]).unwrap();
    assert_eq!((scene.size, scene.background, scene.field), ([800, 600], [0.0; 4], None));
    assert!(scene.transfer.is_none());
    assert_eq!(scene.optics, Optics::PLAIN);
}

#[test]
fn a_gaussian_is_read_in_radians_and_linear_colour() {
    let scene = Scene::parse(GAUSSIAN, &[]).unwrap();
    let widget = &widgets(&scene)[0];
    let WidgetShape::Gaussian { center, sigma, angle } = widget.shape else { panic!("a gaussian") };
    assert_eq!((center, sigma), ([1.0, 2.0], [0.5, 1.0]));
    assert!((angle - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    // 0x80 / 255 by the sRGB curve.
    assert!((widget.color[1] - 0.215_860_5).abs() < 1e-6 && widget.color[0] == 1.0 && widget.color[2] == 0.0);
    assert_eq!((widget.extinction, widget.scalar_range, widget.gradient_range), (3.0, Some([0.0, 2.0]), None));
}

#[test]
fn documented_and_bundled_scenes_are_scenes() {
    let page = include_str!("../docs/scene.md");
    let snippets: Vec<&str> = page.split("```toml\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert_eq!(snippets.len(), 4);
    for text in snippets.into_iter().chain([include_str!("../examples/fire.toml")]) {
        assert!(Scene::parse(text, &[]).unwrap().transfer.is_some());
    }
}

#[test]
fn overrides_replace_append_and_switch() {
    let text = format!("[camera]\nazimuth = 10\n{GAUSSIAN}");
    let choices = [
        set("transfer.widget.0.extinction", "7"),
        set("transfer.widget.1.shape", "uniform"),
        set("transfer.widget.1.color", "[0, 0, 1]"),
        set("transfer.widget.1.extinction", "0.5"),
        set("camera.eye", "[9, 9, 9]"),
        set("field.scalar", "t"),
    ];
    let scene = Scene::parse(&text, &choices).unwrap();
    assert_eq!(widgets(&scene).iter().map(|w| w.extinction).collect::<Vec<_>>(), [7.0, 0.5]);
    assert!(matches!(scene.camera.viewpoint, Viewpoint::At { .. }));
    assert_eq!(scene.field.as_deref(), Some("t"));
}

/// Each scene, and what its message must hold: the key, the line, or the flag.
#[test]
fn bad_scenes_are_named_by_key_and_line() {
    let widget =
        |line: &str| format!("[[transfer.widget]]\nshape = \"uniform\"\ncolor = [1, 1, 1]\nextinction = 1\n{line}\n");
    let gaussian = |from: &str, to: &str| GAUSSIAN.replace(from, to);
    let many = widget("").repeat(65);
    let wave = |kind: &str, line: &str| widget(line).replace("uniform", kind);
    let knots = |list: &str| wave("ramp", &format!("knots = {list}"));
    let window = |rest: &str| widget(&format!("window = {{{rest}}}"));
    let cases: Vec<(String, &[&str])> = vec![
        ("colour = 1\n".into(), &["line 1", "colour", "unknown field"]),
        ("[image]\nwidth = 0\n".into(), &["line 2", "image.width", "1..32768"]),
        ("[image]\nheight = -5\n".into(), &["line 2", "image.height"]),
        ("[image]\nwidth = 30000\nheight = 30000\n".into(), &["image.width", "pixels"]),
        ("[image]\nwidth = \"wide\"\n".into(), &["line 2", "image.width", "a whole number"]),
        ("[image]\nbackground = [1, 1]\n".into(), &["line 2", "image.background", "4 channels"]),
        ("[image]\nbackground = [1, 1, 1, 2]\n".into(), &["image.background", "0..1"]),
        ("[field]\nscalar = \"\"\n".into(), &["field.scalar", "empty"]),
        ("[camera]\nfov_y = 180\n".into(), &["line 2", "camera.fov_y", "180"]),
        ("[camera]\nfov_y = nan\n".into(), &["camera.fov_y"]),
        ("[camera]\nheight = 0\n".into(), &["camera.height"]),
        ("[camera]\nheight = 1\nfov_y = 30\n".into(), &["camera.height", "fov_y"]),
        ("[camera]\nnear = 0\n".into(), &["camera.near"]),
        ("[camera]\nzoom = 0\n".into(), &["camera.zoom"]),
        ("[camera]\nazimuth = inf\n".into(), &["camera.azimuth"]),
        ("[camera]\neye = [1, 2, 3]\nazimuth = 5\n".into(), &["camera.azimuth", "camera.eye"]),
        ("[camera]\ntarget = [1, 2, 3]\n".into(), &["camera.target", "camera.eye"]),
        ("[camera]\neye = [1, 2]\n".into(), &["line 2", "camera.eye", "3 numbers"]),
        ("[camera]\neye = [1, 2, 3, 4]\n".into(), &["line 2", "camera.eye", "3 numbers"]),
        ("[camera]\neye = [1, 2, 3]\ntarget = [1, 2, 3]\nup = [0, 0, 1]\n".into(), &["line 3", "camera.target"]),
        ("[camera]\neye = [0, 0, 3]\ntarget = [0, 0, 0]\nup = [0, 0, 1]\n".into(), &["line 4", "camera.up"]),
        (gaussian("[0.5, 1]", "[0, 1]"), &["line 4", "transfer.widget.0.sigma", "above 0"]),
        (gaussian("[0.5, 1]", "[0.5, -1]"), &["line 4", "transfer.widget.0.sigma"]),
        (gaussian("sigma = [0.5, 1]\n", ""), &["line 1", "transfer.widget.0.sigma", "needs"]),
        (gaussian("extinction = 3", "extinction = -3"), &["line 7", "transfer.widget.0.extinction"]),
        (gaussian("extinction = 3", "extinction = inf"), &["transfer.widget.0.extinction"]),
        (gaussian("extinction = 3\n", ""), &["line 1", "transfer.widget.0", "missing field `extinction`"]),
        (gaussian("[0, 2]", "[2, 0]"), &["line 8", "transfer.widget.0.scalar_range"]),
        (gaussian("#ff8000", "#ff80"), &["line 6", "transfer.widget.0.color", "#rrggbb"]),
        (gaussian("\"#ff8000\"", "[1, -1, 0]"), &["transfer.widget.0.color"]),
        (gaussian("\"#ff8000\"", "7"), &["line 6", "transfer.widget.0.color", "#rrggbb"]),
        (gaussian("gaussian", "cube"), &["line 2", "transfer.widget.0.shape", "cube"]),
        (widget("sigma = [1, 1]"), &["line 5", "transfer.widget.0.sigma"]),
        (widget("sigam = [1, 1]"), &["line 5", "transfer.widget.0.sigam", "unknown field"]),
        (widget("gradient_range = [3, 2]"), &["transfer.widget.0.gradient_range"]),
        (widget("") + &widget("extinction = 2"), &["line 10", "duplicate key"]),
        (many, &["transfer.widget.64", "at most 64"]),
        (wave("triangle", ""), &["line 1", "transfer.widget.0.period", "needs"]),
        (wave("sinusoid", ""), &["transfer.widget.0.period", "needs"]),
        (wave("triangle", "period = 0"), &["line 5", "transfer.widget.0.period", "above 0"]),
        (wave("sinusoid", "period = -1"), &["line 5", "transfer.widget.0.period", "above 0"]),
        (wave("sinusoid", "period = inf"), &["transfer.widget.0.period", "finite"]),
        (wave("triangle", "period = 1\noffset = nan"), &["line 6", "transfer.widget.0.offset", "finite"]),
        (wave("triangle", "period = 1\nduty = 0"), &["line 6", "transfer.widget.0.duty", "at most 1"]),
        (wave("triangle", "period = 1\nduty = 1.5"), &["transfer.widget.0.duty", "1.5"]),
        (wave("triangle", "period = 1\nduty = nan"), &["transfer.widget.0.duty"]),
        (wave("triangle", "period = 1\nvariant = \"cos\""), &["line 6", "transfer.widget.0.variant", "has none"]),
        (wave("sinusoid", "period = 1\nduty = 0.5"), &["line 6", "transfer.widget.0.duty", "has none"]),
        (wave("sinusoid", "period = 1\nvariant = \"saw\""), &["line 6", "transfer.widget.0.variant", "saw"]),
        (wave("sinusoid", "period = 1\ndirection = [0, 0]"), &["line 6", "transfer.widget.0.direction", "zero"]),
        (wave("sinusoid", "period = 1\ndirection = [1, inf]"), &["transfer.widget.0.direction", "finite"]),
        (wave("ramp", ""), &["transfer.widget.0.knots", "needs"]),
        (wave("ramp", "center = [0, 0]"), &["line 5", "transfer.widget.0.center", "has none"]),
        (knots("[]"), &["line 5", "transfer.widget.0.knots", "at least two"]),
        (knots("[[0, 1]]"), &["transfer.widget.0.knots", "at least two"]),
        (knots("[[0, 1], [0, 1]]"), &["line 5", "transfer.widget.0.knots.1", "increase"]),
        (knots("[[0, 1], [1, -1]]"), &["transfer.widget.0.knots.1", "negative"]),
        (knots("[[0, 1], [nan, 1]]"), &["transfer.widget.0.knots.1", "finite"]),
        (knots("[[0, 1], [1]]"), &["line 5", "2 numbers"]),
        (window(""), &["line 5", "transfer.widget.0.window", "missing field `knots`"]),
        (window("knots = [[1, 1], [0, 1]]"), &["line 5", "transfer.widget.0.window.knots.1", "increase"]),
        (window("knots = [[0, 1], [1, 1]], direction = [0, 0]"), &["transfer.widget.0.window.direction", "zero"]),
        (window("knots = [[0, 1], [1, 1]], period = 1"), &["line 5", "period", "unknown field"]),
        ("[transfer]\nemission = \"bright\"\n".into(), &["line 2", "transfer.emission", "bright"]),
        ("[lighting]\nambient = -1\n".into(), &["line 2", "lighting.ambient", "negative"]),
        ("[lighting]\nspecular = inf\n".into(), &["lighting.specular", "finite"]),
        ("[lighting]\nshininess = 0\n".into(), &["line 2", "lighting.shininess", "above 0"]),
        ("[lighting]\ndirection = [0, 0, 0]\n".into(), &["line 2", "lighting.direction", "zero"]),
        ("[lighting]\nspace = \"eye\"\n".into(), &["line 2", "lighting.space", "eye"]),
        ("[lighting]\ncolor = [1, 1, 1]\n".into(), &["line 2", "lighting.color", "unknown field"]),
        ("[silhouette]\nexponent = 0\n".into(), &["line 2", "silhouette.exponent", "above 0"]),
        ("[silhouette]\nstrength = 1.5\n".into(), &["line 2", "silhouette.strength", "0..1"]),
        ("[silhouette]\nmode = \"ink\"\n".into(), &["line 2", "silhouette.mode", "ink"]),
        ("[transfer]\nunits = \"data\"\n".into(), &["transfer", "neither"]),
        ("units = \"data\"\n".into(), &["units"]),
        ("[transfer]\nunits = \"si\"\n".into(), &["line 2", "transfer.units", "si"]),
        ("[transfer.curve]\npoints = []\n".into(), &["line 2", "transfer.curve.points"]),
        (
            "[transfer.curve]\npoints = [[0, 1, 1, 1, 1], [0, 1, 1, 1, 1]]\n".into(),
            &["transfer.curve.points.1", "increase"],
        ),
        ("[transfer.curve]\npoints = [[0, 1, 1, 1]]\n".into(), &["line 2", "transfer.curve.points.0", "5 numbers"]),
        ("[transfer.curve]\npoints = [[0, 1, 1, 1, -1]]\n".into(), &["transfer.curve.points.0", "negative"]),
        (widget("") + "[transfer.curve]\npoints = [[0, 1, 1, 1, 1]]\n", &["transfer.curve", "excludes"]),
        ("[transfer]\ndraw = \"curve\"\n".to_owned() + &widget(""), &["transfer.draw", "no curve"]),
        ("[clip]\nmin = [0, 1, 0]\nmax = [1, 1, 1]\n".into(), &["clip.max", "y reaches from 1 to 1"]),
        ("[clip]\nmin = [0, 0, 0]\nmax = [1, inf, 1]\n".into(), &["clip.max", "finite"]),
        ("[clip]\nmin = [0, 0, 0]\n".into(), &["max"]),
        ("[camera\n".into(), &["line 1"]),
    ];
    for (text, parts) in cases {
        let error = Scene::parse(&text, &[]).expect_err(&text);
        assert_eq!(error.exit_code(), 2, "{text}");
        for part in parts {
            assert!(error.to_string().contains(part), "{text}\n-> {error}\nlacks {part}");
        }
    }
}

#[test]
fn bad_overrides_are_named_by_their_flag() {
    for (key, value, part) in [
        ("transfer.widget.0.sigma", "[0, 1]", "above 0"),
        ("transfer.widget.0.sigma", "[\"a\", 1]", "invalid type"),
        ("transfer.widget.0.sigam", "[1, 1]", "unknown field"),
        ("transfer.widget.5.color", "[1, 1, 1]", "count from 0"),
        ("transfer.widget.0.angle.x", "1", "below a plain value"),
        ("camera.fov_y", "0", "180 degrees"),
    ] {
        let error = Scene::parse(GAUSSIAN, &[set(key, value)]).expect_err(key).to_string();
        assert!(error.starts_with(&format!("--set {key}={value}")) && error.contains(part), "{error}");
    }
}

const WAVES: &str = r#"
[[transfer.widget]]
shape = "triangle"
direction = [3, 4]
offset = 0.1
period = 0.3
duty = 0.5
color = [1, 0, 0]
extinction = 2
window = {direction = [0, 2], knots = [[0.1, 0.2], [0.9, 1]]}

[[transfer.widget]]
shape = "sinusoid"
period = 0.25
variant = "half"
color = [0, 1, 0]
extinction = 3

[[transfer.widget]]
shape = "ramp"
direction = [1, -1]
knots = [[-0.5, 0], [0.1, 1], [0.6, 0.25]]
color = [0, 0, 1]
extinction = 4
scalar_range = [0.2, 0.8]
"#;

#[test]
fn waves_ramps_and_windows_are_read_with_unit_directions() {
    let scene = Scene::parse(WAVES, &[]).unwrap();
    let [tents, half, ramp] = widgets(&scene) else { panic!("three widgets") };
    let close = |got: [f64; 2], want: [f64; 2]| (0..2).all(|i| (got[i] - want[i]).abs() < 1e-15);
    let WidgetShape::Triangle { direction, offset, period, duty } = tents.shape else { panic!("tents") };
    assert!(close(direction, [0.6, 0.8]), "{direction:?}");
    assert_eq!((offset, period, duty), (0.1, 0.3, 0.5));
    let window = Window { direction: [0.0, 1.0], knots: vec![[0.1, 0.2], [0.9, 1.0]] };
    assert_eq!(tents.window.as_ref(), Some(&window));
    let variant = SinusoidVariant::Half;
    let along_scalar = WidgetShape::Sinusoid { direction: [1.0, 0.0], offset: 0.0, period: 0.25, variant };
    assert_eq!((&half.shape, &half.window), (&along_scalar, &None));
    let WidgetShape::Ramp { direction, ref knots } = ramp.shape else { panic!("a ramp") };
    let root = 0.5f64.sqrt();
    assert!(close(direction, [root, -root]) && knots.len() == 3, "{:?}", ramp.shape);
    // Neither square may leave f64's range.
    let far = Scene::parse(&WAVES.replace("[3, 4]", "[3e300, 4e300]"), &[]).unwrap();
    let WidgetShape::Triangle { direction, .. } = widgets(&far)[0].shape else { panic!("tents") };
    assert!(close(direction, [0.6, 0.8]), "{direction:?}");
}

/// A scene in normalised units means, at every point, what the same numbers mean at the point's normalised place.
#[test]
fn normalized_units_keep_every_shape() {
    let text = format!("units = \"normalized\"\n{WAVES}{}", GAUSSIAN.replace("[1, 2]", "[0.4, 0.5]"));
    let scene = Scene::parse(&text, &[]).unwrap();
    let choice = scene.transfer.as_ref().unwrap();
    assert_eq!(choice.units, Units::Normalized);
    let (scalar, gradient) = (Interval { min: 300.0, max: 700.0 }, Interval { min: -2e-3, max: 6e-3 });
    let data = choice.resolve(scalar, gradient);
    let (TransferFunction::Widgets(want), TransferFunction::Widgets(got)) = (&choice.function, &data) else {
        panic!("widgets")
    };
    let (mut seen, mut shown) = ([0; 4], [0; 4]);
    for i in 0..=40 {
        for j in 0..=40 {
            let (s, g) = ((f64::from(i) + 0.37) / 41.0, (f64::from(j) + 0.59) / 41.0);
            let (in_s, in_g) = (scalar.min + s * scalar.length(), gradient.min + g * gradient.length());
            for (k, (want, got)) in want.iter().zip(got).enumerate() {
                let (a, b) = (want.extinction_at(s, g), got.extinction_at(in_s, in_g));
                assert!((a - b).abs() < 1e-12 * want.extinction, "widget {k} at {s}, {g}: {a} {b}");
                assert_eq!(want.supports(s, g), got.supports(in_s, in_g), "widget {k} at {s}, {g}");
                seen[k] += usize::from(a > 0.0);
                let planted = got.extinction_at(in_s + 1e-6 * scalar.length(), in_g);
                shown[k] += usize::from((a - planted).abs() >= 1e-12 * want.extinction);
            }
        }
    }
    assert!(seen.iter().all(|&n| n > 100), "{seen:?}");
    assert!((0..4).all(|k| shown[k] * 2 > seen[k]), "a shift by a millionth must show: {shown:?} of {seen:?}");
}

#[test]
fn optics_are_read_and_have_defaults() {
    let text = "[transfer]\nemission = \"unweighted\"\n[lighting]\ndirection = [0, 3, 4]\nspace = \"world\"\n\
                [silhouette]\nmode = \"depth\"\nstrength = 0.5\n";
    let scene = Scene::parse(text, &[]).unwrap();
    assert!(scene.transfer.is_none(), "the default function emits so");
    assert_eq!(scene.optics.emission, EmissionModel::Unweighted);
    let light = scene.optics.lighting.unwrap();
    assert_eq!((light.ambient, light.diffuse, light.specular, light.shininess), (0.3, 0.7, 0.2, 32.0));
    assert!((light.direction - glam::DVec3::new(0.0, 0.6, 0.8)).length() < 1e-15 && light.space == LightSpace::World);
    let silhouette = scene.optics.silhouette.unwrap();
    assert_eq!((silhouette.exponent, silhouette.strength, silhouette.mode), (2.0, 0.5, SilhouetteMode::Depth));
    let flags = [set("lighting.direction", "[0, 0, 2]"), set("silhouette.exponent", "4")];
    let optics = Scene::parse(GAUSSIAN, &flags).unwrap().optics;
    assert_eq!(optics.lighting.unwrap().direction, glam::DVec3::Z);
    assert_eq!((optics.silhouette.unwrap().exponent, optics.silhouette.unwrap().mode), (4.0, SilhouetteMode::Opacity));
    assert!(Scene::parse("[lighting]\n", &[]).unwrap().optics.lighting.is_some());
}

/// Two arches, between values 0 and 1 and between 1 and 3, and three materials at low gradients.
fn arches() -> JointHistogram {
    let bins = [300, 100];
    let (scalar, gradient) = (Interval { min: 0.0, max: 3.0 }, Interval { min: 0.0, max: 10.0 });
    let mut histogram = JointHistogram { bins, counts: vec![0.0; bins[0] * bins[1]], scalar, gradient };
    for index in 0..histogram.counts.len() {
        let [s, g] = histogram.bin_center(index % bins[0], index / bins[0]);
        let arch = |low: f64, high: f64, top: f64| {
            let share = (s - low) / (high - low);
            let at = 4.0 * top * share * (1.0 - share);
            if (0.0..=1.0).contains(&share) { (-((g - at) / 0.4).powi(2)).exp() } else { 0.0 }
        };
        let material = |at: f64| 20.0 * (-((s - at) / 0.05).powi(2) - (g / 0.3).powi(2)).exp();
        histogram.counts[index] =
            arch(0.0, 1.0, 4.0) + arch(1.0, 3.0, 8.0) + material(0.1) + material(1.0) + material(2.9);
    }
    histogram
}

#[test]
fn boundaries_are_the_tops_of_arches_and_materials_their_feet() {
    let (mesh, _) = TetMesh::new(Sample::Tangle.mesh(500), &FieldChoice::default(), HexSplit::Six).unwrap();
    let centers = |widgets: &[Widget]| -> Vec<[f64; 2]> {
        let center = |widget: &Widget| match widget.shape {
            WidgetShape::Gaussian { center, .. } => center,
            _ => panic!("a Gaussian"),
        };
        widgets.iter().map(center).collect()
    };
    let found = centers(&boundaries(&mesh, &arches()));
    assert_eq!(found.len(), 2, "{found:?}");
    assert!((found[0][0] - 0.5).abs() < 0.05 && (found[1][0] - 2.0).abs() < 0.05, "{found:?}");
    assert!((found[1][1] - 8.0).abs() < 0.5, "{found:?}");
    let found = centers(&homogeneous_regions(&mesh, &arches()));
    assert_eq!(found.len(), 3, "{found:?}");
    for (found, want) in found.iter().zip([0.1, 1.0, 2.9]) {
        assert!((found[0] - want).abs() < 0.05 && found[1] < 1.0, "{found:?}");
    }
}
