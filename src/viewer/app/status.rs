//! What is being done, and what was said.

use eframe::egui::{self, Ui};

use super::App;

/// Messages that are shown at a time.
const MESSAGES: usize = 6;
/// Of a message, points: about a line of the longest ones.
const TEXT_WIDTH: f32 = 480.0;

impl App {
    pub(super) fn status(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            if let Some(loading) = &self.loading {
                ui.label(format!("reading {} …", loading.path.display()));
                if ui.small_button("cancel").clicked() {
                    self.loading = None;
                    return;
                }
            }
            if let Some(export) = &self.export {
                let [done, total] = export.progress();
                ui.add(egui::ProgressBar::new(done as f32 / total.max(1) as f32).desired_width(120.0));
                ui.label(format!("writing, {done} of {total}"));
                if ui.small_button("cancel").clicked() {
                    export.cancel();
                }
            }
            if self.sitting.is_some() && self.shown.is_none() {
                ui.label("preparing …");
            }
            if let Some(share) = self.engine.progress().filter(|_| !self.is_answered) {
                ui.add(egui::ProgressBar::new(share as f32).desired_width(120.0).show_percentage());
                if ui.small_button("cancel").clicked() {
                    self.engine.cancel();
                    (self.is_answered, self.is_given_up) = (true, true);
                }
            }
            let Some(shown) = &self.shown else { return };
            // Nothing here turns: drawing the window takes what pictures are made with.
            let state = match shown.step {
                _ if !self.is_cut => "the mesh is being cut …".to_owned(),
                _ if self.is_given_up => "given up".to_owned(),
                _ if !self.is_answered => "a better one is being made …".to_owned(),
                1 => "final".to_owned(),
                step => format!("1/{step} of the pixels along a side"),
            };
            let text = ui.label(format!("{:.0} ms, {state}", 1e3 * shown.seconds));
            if let Some([median, most]) = self.clock.median_and_95th() {
                let [median, most] = [median, most].map(|time| 1e3 * time.as_secs_f64());
                text.on_hover_text(format!("the window itself: a frame in {median:.0} ms, 19 of 20 in {most:.0}"));
            }
            let mut is_refining = self.refining.is_some();
            if let Some(refining) = &self.refining {
                ui.separator();
                let [left, top, right, bottom] = refining.area;
                ui.label(format!("reference of {} × {} pixels", right - left, bottom - top));
                ui.add(egui::ProgressBar::new(refining.progress() as f32).desired_width(120.0).show_percentage());
                is_refining = !ui.small_button("cancel").clicked();
            }
            if !is_refining {
                self.refining = None;
            }
            if let Some(refined) = &self.refined {
                ui.separator();
                let text = match &refined.comparison {
                    Some(c) => format!("{:.1e} from the reference at most, {:.1} dB", c.max, c.psnr),
                    None => "the reference; the picture was not in full".into(),
                };
                ui.label(text).on_hover_text("Of the part: linear channels, before a black background");
            }
            if let Some(compared) = &self.compared {
                let text = format!("differ by {:.1e} at most, {:.1} dB", compared.max, compared.psnr);
                ui.separator();
                ui.label(text).on_hover_text("Linear channels, before a black background");
            }
            if let Some(note) = shown.notes.first() {
                ui.separator();
                ui.add(egui::Label::new(note).truncate()).on_hover_text(shown.notes.join("\n"));
            }
        });
    }

    pub(super) fn said(&mut self, ui: &mut Ui) {
        let mut gone = None;
        // Those before are there when these have been put away.
        let first = self.messages.len().saturating_sub(MESSAGES);
        for (index, text) in self.messages.iter().enumerate().skip(first) {
            ui.horizontal_top(|ui| {
                if ui.small_button("×").on_hover_text("Put it away (Escape: all)").clicked() {
                    gone = Some(index);
                }
                ui.vertical(|ui| {
                    ui.set_width(TEXT_WIDTH);
                    ui.label(text);
                });
            });
        }
        if let Some(index) = gone {
            self.messages.remove(index);
        }
    }
}
