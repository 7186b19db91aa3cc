//! What keys do, and the list of them.

use eframe::egui::{self, Context, Key, KeyboardShortcut, Modifiers};

use super::{App, Compare, FOV_Y, fitted};
use crate::viewer::editor::Tool;
use crate::viewer::files::Purpose;
use crate::viewer::history::History;
use crate::viewer::look::{self, Kind};
use crate::viewer::panels::{self, Todo};

impl App {
    pub(super) fn keys(&mut self, ctx: &Context) {
        if ctx.egui_wants_keyboard_input() || self.dialog.is_some() {
            return;
        }
        let pressed = |modifiers: Modifiers, key: Key| {
            ctx.input_mut(|i| i.consume_shortcut(&KeyboardShortcut::new(modifiers, key)))
        };
        if pressed(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z) || pressed(Modifiers::COMMAND, Key::Y) {
            self.undo(History::redo);
        }
        if pressed(Modifiers::COMMAND, Key::Z) {
            self.undo(History::undo);
        }
        for (key, purpose) in [(Key::O, Purpose::OpenMesh), (Key::S, Purpose::SaveScene), (Key::E, Purpose::Export)] {
            if pressed(Modifiers::COMMAND, key) {
                self.ask(purpose);
            }
        }
        let kind = self.sitting.as_ref().map(|sitting| sitting.look.kind);
        if let (Some(Kind::Univariate), Some(sitting)) = (kind, &mut self.sitting)
            && (pressed(Modifiers::NONE, Key::Delete) || pressed(Modifiers::NONE, Key::Backspace))
        {
            self.curve.delete(&mut sitting.look.curve);
        }
        // What is not seen is not changed.
        if let (Some(Kind::Bivariate), Some(sitting), Some(index)) = (kind, &mut self.sitting, self.editor.selected) {
            if pressed(Modifiers::COMMAND, Key::D) {
                panels::apply(Todo::Copy(index), &mut self.editor, &mut sitting.look);
            }
            let index = self.editor.selected.unwrap_or(index);
            if pressed(Modifiers::NONE, Key::Delete) || pressed(Modifiers::NONE, Key::Backspace) {
                panels::apply(Todo::Delete(index), &mut self.editor, &mut sitting.look);
            }
            if let Some(item) = self.editor.selected.and_then(|index| sitting.look.items.get_mut(index))
                && pressed(Modifiers::NONE, Key::H)
            {
                item.is_hidden = !item.is_hidden;
            }
        }
        for (tool, _, _) in Tool::ALL {
            if pressed(Modifiers::NONE, tool.key()) {
                self.editor.tool = tool;
            }
        }
        if pressed(Modifiers::NONE, Key::Escape) {
            (self.editor.tool, self.editor.brush, self.editor.selected) = (Tool::Move, None, None);
            (self.canvas.is_choosing, self.refining, self.refined) = (false, None, None);
            self.canvas.show_part(ctx, None);
            self.messages.clear();
        }
        if let Some(sitting) = &mut self.sitting {
            if pressed(Modifiers::NONE, Key::F) {
                sitting.camera = fitted(&sitting.opened);
            }
            if pressed(Modifiers::NONE, Key::P) {
                look::switch_projection(&mut sitting.camera, FOV_Y);
            }
            if pressed(Modifiers::NONE, Key::I) {
                sitting.look.clip = if sitting.look.clip.is_none() { Some(sitting.opened.bounds) } else { None };
            }
            if pressed(Modifiers::NONE, Key::L) {
                self.has_legend = !self.has_legend;
            }
            if pressed(Modifiers::NONE, Key::E) {
                self.canvas.is_choosing = !self.canvas.is_choosing;
            }
            if pressed(Modifiers::NONE, Key::K) {
                sitting.look.kind = other(sitting.look.kind);
            }
        }
        if pressed(Modifiers::NONE, Key::C) {
            self.compare = match self.compare {
                Compare::Off => Compare::Kinds,
                Compare::Kinds => Compare::Methods,
                Compare::Methods => Compare::Off,
            };
        }
        if pressed(Modifiers::NONE, Key::X) {
            self.canvas.has_box = !self.canvas.has_box;
        }
        if pressed(Modifiers::NONE, Key::F1) || pressed(Modifiers::SHIFT, Key::Questionmark) {
            self.has_help = !self.has_help;
        }
    }
}

fn other(kind: Kind) -> Kind {
    match kind {
        Kind::Bivariate => Kind::Univariate,
        Kind::Univariate => Kind::Bivariate,
    }
}

/// The list of what pointer and keys do.
pub(super) fn help(ctx: &Context, is_open: &mut bool) {
    egui::Window::new("Help").open(is_open).resizable(false).show(ctx, |ui| {
        for (what, how) in [
            ("Turn the picture", "drag"),
            ("Move it", "right button, or Shift and drag"),
            ("Zoom", "wheel, two fingers, pinch"),
            ("Roll it", "Ctrl and drag"),
            ("Fly", "arrow keys, Page Up, Page Down over the picture"),
            ("Fit, parallel rays, box, legend", "F, P, X, L"),
            ("Clipping box", "I; pull the dots on its sides"),
            ("The reference of a part", "E, then drag a box on the picture"),
            ("1D or 2D function, compare", "K, C"),
            ("Tools on the histogram", "V move, G Gaussian, T triangle, S sinusoid, U box, R ramp, B brush"),
            ("Zoom the histogram, move it", "wheel; right button, or Shift and drag; double click: all"),
            ("Widget: copy, hide, delete", "Ctrl+D, H, Delete"),
            ("Undo, redo", "Ctrl+Z, Ctrl+Y"),
            ("Open, save the scene, export", "Ctrl+O, Ctrl+S, Ctrl+E"),
            ("Larger and smaller letters", "Ctrl+plus, Ctrl+minus, Ctrl+0"),
            ("Let go", "Escape"),
        ] {
            ui.horizontal(|ui| {
                ui.label(what);
                ui.weak(how);
            });
        }
    });
}
