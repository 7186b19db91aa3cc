//! Scene files as users write them: what is read, what flags change, and how mistakes are named.

use tetralux::scene::{Override, Scene, TransferFunction, Viewpoint, Widget, WidgetShape};

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
    assert_eq!(snippets.len(), 2);
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
