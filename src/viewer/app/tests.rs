//! The window without a window: its logic is driven by events, pictures are made as ever.

use std::path::Path;
use std::time::Duration;

use eframe::egui::{Event, Key, Modifiers, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;

use self::driven::{drag, fire, place, settle};
use super::{App, Compare, Start};
use crate::cli::args::{Device, IntegralChoice, Order};
use crate::renderer::SegmentIntegral;
use crate::scene::{TransferFunction, WidgetShape};
use crate::viewer::clip_box;
use crate::viewer::engine::How;
use crate::viewer::look::Kind;

#[path = "../../../tests/common/window.rs"]
mod driven;

/// On the CPU, which every machine has.
fn start(mesh: &Path) -> Start {
    let how = How { device: Device::Cpu, ..How::default() };
    Start { mesh: Some(mesh.to_owned()), field: Some("t".into()), scene: None, how }
}

fn window(start: Start) -> Harness<'static, App> {
    let size = vec2(1280.0, 800.0);
    Harness::builder()
        .with_size(size)
        .build_eframe(|context| App::new(context, start, None).unwrap_or_else(|e| panic!("{e}")))
}

fn press(window: &mut Harness<'_, App>, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.step();
    window.step();
}

/// Types a name into the dialog, and takes it.
fn answer(window: &mut Harness<'_, App>, name: &Path, verb: &str) {
    window.step();
    window.get_by_label("File name").focus();
    window.step();
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.step();
    window.event(Event::Text(name.display().to_string()));
    window.step();
    window.get_by_label(verb).click();
    window.step();
    window.step();
}

fn items(window: &Harness<'_, App>) -> usize {
    window.state().look().map_or(0, |look| look.items.len())
}

/// A whole session: a mesh is opened, a Gaussian drawn, the picture turned, the scene saved, undone, compared, exported.
#[test]
fn a_session() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(start(&fire()));
    settle(&mut window);
    let before = items(&window);
    assert!(before > 0, "something is suggested");
    // A Gaussian where the press is, as wide as the pull.
    press(&mut window, Modifiers::NONE, Key::G);
    let plot = place(&window, "Joint histogram");
    let from = plot.min + 0.45 * plot.size();
    drag(&mut window, from, from + vec2(40.0, -25.0));
    assert_eq!(items(&window), before + 1);
    let shape = |window: &Harness<'_, App>| {
        window.state().look().and_then(|look| look.items.last()).map(|item| item.widget.shape.clone())
    };
    let drawn = shape(&window).expect("a widget");
    assert!(matches!(drawn, WidgetShape::Gaussian { angle: 0.0, .. }), "{drawn:?}");
    // Its middle is taken hold of, and it comes along.
    drag(&mut window, from, from + vec2(-30.0, 12.0));
    let moved = shape(&window).expect("a widget");
    assert_ne!(moved, drawn);
    settle(&mut window);
    // A drag is one step.
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(shape(&window).as_ref(), Some(&drawn));
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(items(&window), before);
    press(&mut window, Modifiers::COMMAND, Key::Y);
    press(&mut window, Modifiers::COMMAND, Key::Y);
    assert_eq!(shape(&window).as_ref(), Some(&moved));
    // The picture turns; the camera is no step.
    let camera = |window: &Harness<'_, App>| window.state().sitting.as_ref().map(|sitting| sitting.camera);
    let eye = camera(&window);
    let picture = place(&window, "Picture").center();
    drag(&mut window, picture, picture + vec2(90.0, 30.0));
    assert_ne!(camera(&window), eye);
    settle(&mut window);
    // A side of the clipping box is pulled, and the mesh cut there.
    press(&mut window, Modifiers::NONE, Key::I);
    let clip = |window: &Harness<'_, App>| window.state().look().and_then(|look| look.clip);
    let whole = clip(&window).expect("a box");
    let [from, to] = side_and_middle(&window);
    drag(&mut window, from, from + 0.4 * (to - from));
    let cut = clip(&window).expect("a box");
    assert!(cut.max.z < whole.max.z && cut.min == whole.min, "{cut:?}");
    settle(&mut window);
    assert!(window.state().messages().is_empty(), "{:?}", window.state().messages());
    // A widget that is hidden stays in the scene.
    window.state_mut().editor.selected = Some(before);
    press(&mut window, Modifiers::NONE, Key::H);
    // 1D beside 2D.
    press(&mut window, Modifiers::NONE, Key::C);
    settle(&mut window);
    assert_eq!(window.state().compare, Compare::Kinds);
    let compared = window.state().compared.as_ref().expect("two pictures");
    assert!(compared.max > 0.01 && window.state().pictures.len() == 2, "{compared}");
    press(&mut window, Modifiers::NONE, Key::C);
    press(&mut window, Modifiers::NONE, Key::C);
    settle(&mut window);
    // What is saved and exported is what the command line makes of it.
    let [scene, exported, rendered] = ["s.toml", "e.png", "r.png"].map(|name| folder.path().join(name));
    press(&mut window, Modifiers::COMMAND, Key::S);
    answer(&mut window, &scene, "Write");
    let text = std::fs::read_to_string(&scene).unwrap_or_else(|e| panic!("{e}: {:?}", window.state().messages()));
    assert!(text.contains("[clip]") && text.matches("hidden = true").count() == 1, "{text}");
    press(&mut window, Modifiers::COMMAND, Key::E);
    answer(&mut window, &exported, "Write");
    settle(&mut window);
    assert!(exported.is_file(), "{:?}", window.state().messages());
    let words = ["tetralux", "render", "--device", "cpu", "--integral", "auto", "--scene"];
    let files = [scene.as_path(), Path::new("-o"), rendered.as_path(), &fire()].map(|path| path.as_os_str().to_owned());
    assert_eq!(crate::cli::main(words.map(Into::into).into_iter().chain(files)), 0);
    let bytes = |path: &Path| std::fs::read(path).expect("a picture");
    assert!(bytes(&exported) == bytes(&rendered), "the window's picture is the command line's");
    let lit = crate::image::Image::read(&exported).expect("a picture").pixels;
    assert!(lit.iter().filter(|p| p[0].max(p[1]).max(p[2]) > 0.05).count() > 1_000, "something is seen");
}

/// On the screen: the handle of the upper side along z, and the box's middle.
fn side_and_middle(window: &Harness<'_, App>) -> [Pos2; 2] {
    let sitting = window.state().sitting.as_ref().expect("a mesh");
    let (bounds, picture) = (sitting.opened.mesh.bounds_in_data(), place(window, "Picture"));
    let middle = bounds.center();
    let top = glam::DVec3 { z: bounds.max.z, ..middle };
    [top, middle].map(|place| clip_box::project(&sitting.camera, picture, place).expect("before the eye"))
}

#[test]
fn the_reference_takes_a_part_of_the_picture() {
    let mut window = window(start(&fire()));
    settle(&mut window);
    press(&mut window, Modifiers::NONE, Key::E);
    let picture = place(&window, "Picture").center();
    drag(&mut window, picture, picture + vec2(30.0, 20.0));
    settle(&mut window);
    let refined = window.state().refined.as_ref().expect("a part");
    let compared = refined.comparison.as_ref().expect("the picture is in full");
    assert_eq!([refined.image.width, refined.image.height], [30, 20]);
    assert!(compared.max > 0.0 && compared.psnr > 80.0, "{compared}");
    // It is of one picture.
    drag(&mut window, picture, picture + vec2(40.0, 0.0));
    assert!(window.state().refined.is_none());
}

#[test]
fn a_still_can_be_given_up() {
    let mut window = window(start(&fire()));
    settle(&mut window);
    window.state_mut().how[0].device = Device::Oracle;
    for _ in 0..2_000 {
        window.step();
        if window.state().engine.progress().is_some() {
            break;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    window.step();
    window.get_by_label("cancel").click();
    window.step();
    window.step();
    assert!(window.state().is_given_up && window.state().is_idle());
    assert!(window.state().shown.as_ref().is_some_and(|shown| shown.step > 1 || shown.notes[0].contains("CPU")));
    // What is asked for next is made.
    window.state_mut().how[0].device = Device::Cpu;
    settle(&mut window);
    assert!(!window.state().is_given_up && window.state().messages().is_empty(), "{:?}", window.state().messages());
}

/// A pull goes from tick to tick where that is asked for.
#[test]
fn what_is_pulled_can_snap() {
    let mut window = window(start(&fire()));
    settle(&mut window);
    assert!(!window.state().editor.snaps);
    window.state_mut().editor.snaps = true;
    press(&mut window, Modifiers::NONE, Key::G);
    let plot = place(&window, "Joint histogram");
    let from = plot.min + 0.43 * plot.size();
    drag(&mut window, from, from + vec2(40.0, -25.0));
    let center = |window: &Harness<'_, App>| match window.state().look()?.items.last()?.widget.shape {
        WidgetShape::Gaussian { center, .. } => Some(center),
        _ => None,
    };
    let before = center(&window).expect("a Gaussian");
    let is_round = |v: f64| (v / 10.0 - (v / 10.0).round()).abs() < 1e-6;
    assert!(is_round(before[0]) && is_round(before[1]), "{before:?}");
}

#[test]
fn what_is_wrong_is_said_and_the_session_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    let broken = folder.path().join("broken.vtu");
    std::fs::write(&broken, "<VTKFile type=\"UnstructuredGrid\"><Unst").expect("written");
    let mut window = window(start(&fire()));
    settle(&mut window);
    let before = window.state().look().cloned();
    let said = |window: &Harness<'_, App>, what: &str| {
        let messages = window.state().messages();
        assert!(messages.last().is_some_and(|text| text.contains(what)), "{what}: {messages:?}");
    };
    press(&mut window, Modifiers::COMMAND, Key::O);
    answer(&mut window, &broken, "Open");
    settle(&mut window);
    said(&window, "broken.vtu");
    // A field that is not there any more.
    let ctx = window.ctx.clone();
    window.state_mut().open(&ctx, fire(), Some("vanished".into()));
    settle(&mut window);
    said(&window, "vanished");
    // Nowhere to write to.
    press(&mut window, Modifiers::COMMAND, Key::E);
    answer(&mut window, &folder.path().join("no folder/picture.png"), "Write");
    settle(&mut window);
    said(&window, "folder");
    press(&mut window, Modifiers::COMMAND, Key::S);
    answer(&mut window, &folder.path().join("no folder/scene.toml"), "Write");
    said(&window, "folder");
    // A device that refuses, as a lost one does.
    window.state_mut().how[0].choices.order = Order::Structured;
    window.state_mut().how[0].device = Device::Software;
    settle(&mut window);
    assert!(window.state().messages().len() >= 5, "{:?}", window.state().messages());
    assert_eq!(window.state().look().cloned(), before);
    window.state_mut().how[0] = How { device: Device::Cpu, ..How::default() };
    settle(&mut window);
    assert_eq!(window.state().look().cloned(), before, "the session is kept");
}

/// A still that takes long is not waited for: frames come, and do what is asked.
#[test]
fn nothing_waits_for_a_still() {
    let mut window = window(start(&fire()));
    settle(&mut window);
    window.state_mut().how[0].device = Device::Oracle;
    window.step();
    assert!(!window.state().is_idle());
    let camera = |window: &Harness<'_, App>| window.state().sitting.as_ref().map(|sitting| sitting.camera);
    let eye = camera(&window);
    let picture = place(&window, "Picture").center();
    drag(&mut window, picture, picture + vec2(50.0, 10.0));
    assert_ne!(camera(&window), eye);
    press(&mut window, Modifiers::NONE, Key::K);
    assert_eq!(window.state().look().map(|look| look.kind), Some(Kind::Univariate));
    assert!(!window.state().is_idle(), "the reference cannot be done yet");
    // What is asked for now is made in place of it.
    window.state_mut().how[0].device = Device::Cpu;
    settle(&mut window);
}

#[test]
fn two_methods_are_compared_in_linear_float() {
    let mut window = window(start(&fire()));
    settle(&mut window);
    window.state_mut().compare = Compare::Methods;
    window.state_mut().how[0].choices.integral = IntegralChoice::Fixed(SegmentIntegral::default());
    window.state_mut().how[1] = window.state().how[0];
    settle(&mut window);
    assert_eq!(window.state().compared.as_ref().map(|c| c.max), Some(0.0), "the same twice");
    window.state_mut().how[1].choices.integral = IntegralChoice::Fixed(SegmentIntegral::MeanScalar);
    settle(&mut window);
    assert!(window.state().compared.as_ref().is_some_and(|c| c.max > 1e-4), "two integrals");
}

/// What is suggested is one click, and one undo.
#[test]
fn suggestions_can_be_undone() {
    let mut window = window(start(&fire()));
    settle(&mut window);
    let before = window.state().look().cloned();
    for name in ["Boundaries", "Homogeneous regions"] {
        window.get_by_label("Suggest").click();
        window.step();
        window.step();
        window.get_by_label(name).click();
        window.step();
        window.step();
        settle(&mut window);
        let look = window.state().look().cloned().expect("a look");
        assert_ne!(Some(&look), before.as_ref(), "{name}");
        let TransferFunction::Widgets(widgets) = look.transfer(Kind::Bivariate) else { panic!("widgets") };
        assert!((1..=4).contains(&widgets.len()), "{name}: {}", widgets.len());
        press(&mut window, Modifiers::COMMAND, Key::Z);
        assert_eq!(window.state().look().cloned(), before, "{name}");
    }
}
