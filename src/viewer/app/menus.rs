//! The menus.

use eframe::egui::{self, Ui};

use super::{App, Compare, FOV_Y, fitted};
use crate::scene::{self, Projection};
use crate::tet::Domain as _;
use crate::viewer::canvas::Together;
use crate::viewer::files::Purpose;
use crate::viewer::history::History;
use crate::viewer::look::{self, Item, Kind};

impl App {
    pub(super) fn menus(&mut self, ui: &mut Ui) {
        egui::MenuBar::new().ui(ui, |ui| {
            ui.menu_button("File", |ui| self.file_menu(ui));
            ui.menu_button("Edit", |ui| {
                let steps = self.sitting.as_ref().map_or([0; 2], |sitting| sitting.history.steps());
                if ui.add_enabled(steps[0] > 0, egui::Button::new("Undo").shortcut_text("Ctrl+Z")).clicked() {
                    self.undo(History::undo);
                    ui.close();
                }
                if ui.add_enabled(steps[1] > 0, egui::Button::new("Redo").shortcut_text("Ctrl+Y")).clicked() {
                    self.undo(History::redo);
                    ui.close();
                }
                ui.separator();
                ui.checkbox(&mut self.editor.snaps, "Snap to the histogram's ticks");
            });
            ui.menu_button("View", |ui| self.view_menu(ui));
            ui.menu_button("Suggest", |ui| self.suggest_menu(ui));
            ui.menu_button("Compare", |ui| {
                for (value, name) in [
                    (Compare::Off, "Nothing"),
                    (Compare::Kinds, "1D with 2D classification"),
                    (Compare::Methods, "Two methods"),
                ] {
                    ui.radio_value(&mut self.compare, value, name);
                }
                ui.separator();
                ui.radio_value(&mut self.canvas.together, Together::Split, "Side by side");
                ui.radio_value(&mut self.canvas.together, Together::Difference, "Difference × 16");
                ui.separator();
                let reference = egui::Button::new("The reference, of a part").shortcut_text("E");
                let help = "Drag a box on the picture: its pixels in f64, and how far the picture is from them";
                if ui.add(reference).on_hover_text(help).clicked() {
                    self.canvas.is_choosing = true;
                    ui.close();
                }
            });
            if ui.button("Help").clicked() {
                self.has_help = !self.has_help;
            }
            self.field_choice(ui);
        });
    }

    pub(super) fn file_menu(&mut self, ui: &mut Ui) {
        for (purpose, name, shortcut) in [
            (Purpose::OpenMesh, "Open mesh…", "Ctrl+O"),
            (Purpose::OpenScene, "Open scene…", ""),
            (Purpose::SaveScene, "Save scene…", "Ctrl+S"),
            (Purpose::Export, "Export picture…", "Ctrl+E"),
        ] {
            if ui.add(egui::Button::new(name).shortcut_text(shortcut)).clicked() {
                self.ask(purpose);
                ui.close();
            }
        }
        let command = self.command();
        if ui.add_enabled(command.is_some(), egui::Button::new("Copy as command")).clicked() {
            let is_saved = self.sitting.as_ref().is_some_and(|sitting| sitting.file.is_some());
            ui.ctx().copy_text(command.unwrap_or_default());
            self.say(if is_saved { "copied the command" } else { "copied the command: save the scene as scene.toml" });
            ui.close();
        }
    }

    pub(super) fn view_menu(&mut self, ui: &mut Ui) {
        let Some(sitting) = &mut self.sitting else { return };
        if ui.add(egui::Button::new("Fit").shortcut_text("F")).clicked() {
            sitting.camera = fitted(&sitting.opened);
        }
        let mut is_parallel = matches!(sitting.camera.projection, Projection::Orthographic { .. });
        if ui.checkbox(&mut is_parallel, "Parallel rays (P)").changed() {
            look::switch_projection(&mut sitting.camera, FOV_Y);
        }
        ui.checkbox(&mut self.canvas.has_box, "Box (X)");
        ui.checkbox(&mut self.has_legend, "Legend (L)");
        let mut is_clipped = sitting.look.clip.is_some();
        if ui.checkbox(&mut is_clipped, "Clipping box (I)").changed() {
            sitting.look.clip = is_clipped.then_some(sitting.opened.bounds);
        }
        ui.separator();
        for (name, away) in [("Along x", glam::DVec3::X), ("Along y", glam::DVec3::Y), ("Along z", glam::DVec3::Z)] {
            if ui.button(name).clicked() {
                let distance = sitting.camera.eye.distance(sitting.camera.target);
                sitting.camera.eye = sitting.camera.target + distance * away;
                sitting.camera.up = if away == glam::DVec3::Z { glam::DVec3::Y } else { glam::DVec3::Z };
                ui.close();
            }
        }
        ui.separator();
        egui::global_theme_preference_buttons(ui);
    }

    pub(super) fn suggest_menu(&mut self, ui: &mut Ui) {
        let Some(sitting) = &mut self.sitting else { return };
        let (mesh, histogram) = (&*sitting.opened.mesh, &*sitting.opened.histogram);
        let mut found = None;
        if ui.button("Boundaries").on_hover_text("Where materials meet (Kindlmann & Durkin 1998)").clicked() {
            found = Some(scene::boundaries(mesh, histogram));
        }
        if ui.button("Homogeneous regions").on_hover_text("What most of the volume is made of").clicked() {
            found = Some(scene::homogeneous_regions(mesh, histogram));
        }
        if ui.button("Where most varies").on_hover_text("What the window began with").clicked() {
            found = match scene::suggest(mesh, histogram) {
                scene::TransferFunction::Widgets(widgets) => Some(widgets),
                scene::TransferFunction::Curve(_) => None,
            };
        }
        let Some(widgets) = found else { return };
        ui.close();
        if widgets.is_empty() {
            self.messages.push("the histogram shows none".into());
            return;
        }
        sitting.look.items = widgets.into_iter().map(|widget| Item { widget, is_hidden: false }).collect();
        (sitting.look.kind, sitting.look.solo, self.editor.selected) = (Kind::Bivariate, None, None);
    }

    pub(super) fn field_choice(&mut self, ui: &mut Ui) {
        let Some(sitting) = &self.sitting else { return };
        let (now, path) = (sitting.opened.mesh.field().to_owned(), sitting.opened.path.clone());
        let mut wanted = None;
        ui.separator();
        egui::ComboBox::from_id_salt("field").selected_text(&now).show_ui(ui, |ui| {
            for field in &sitting.opened.fields {
                if ui.selectable_label(*field == now, field).clicked() && *field != now {
                    wanted = Some(field.clone());
                }
            }
        });
        if let Some(field) = wanted {
            self.open(ui.ctx(), path, Some(field));
        }
    }
}
