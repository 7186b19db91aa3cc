//! One HTML file that asks nobody for anything: charts, pictures and tables within, light and dark.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use plotters::style::RGBColor;

use super::chart::Chart;
use super::marks::{DARK, LIGHT, Theme};
use super::points::Points;
use super::strips::{GAIN, Strip};
use super::table;
use super::words::{self, escape};
use crate::report::record::Record;

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// Charts of one kind.
pub(super) struct Section {
    pub id: &'static str,
    pub title: &'static str,
    /// How to read them.
    pub text: &'static str,
    pub charts: Vec<Chart>,
    /// What has no chart, and why.
    pub left_out: Vec<String>,
}

/// The whole page.
pub(super) fn page(records: &[&Record], points: &Points<'_>, sections: &[Section], strips: &[Strip]) -> String {
    let mut links = String::new();
    let mut body = String::new();
    let mut add = |id: &str, title: &str, text: &str, inner: &str| {
        links += &format!("<a href=\"#{id}\">{title}</a>\n");
        body += &format!("<section id=\"{id}\">\n<h2>{title}</h2>\n<p>{text}</p>\n{inner}</section>\n");
    };
    for section in sections {
        add(section.id, section.title, section.text, &charts(section));
    }
    if !strips.is_empty() {
        let text = format!(
            "The run of each method with the largest error of which pictures are there. Differences are multiplied by \
             {GAIN}, those of opacity are added."
        );
        add("pictures", "Pictures", &text, &pictures(strips));
    }
    let text = "One row a run. Click on a head to sort by it; type to see some rows only.";
    let filter = "<p><label>Rows with <input type=\"search\" id=\"filter\" autocomplete=\"off\"></label> \
                  <output id=\"shown\" for=\"filter\"></output></p>\n";
    add("table", "All runs", text, &format!("{filter}{}", table::runs(records)));
    if records.iter().any(|r| r.refused.is_some()) {
        let text = "What a program would not draw, in its own words.";
        add("not-drawn", "Refused", text, &table::refused(records));
    }
    let text = "Which program ran where, from which sources. The table of runs names machines by these numbers.";
    add("where", "Machines", text, &table::provenance(records));
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; \
         script-src 'unsafe-inline'; img-src data:\">\n\
         <title>Speed and accuracy</title>\n<style>\n{}{STYLE}</style>\n</head>\n<body>\n\
         <header>\n<h1>Speed and accuracy</h1>\n<p>{}</p>\n<nav>\n{links}</nav>\n</header>\n\
         <main>\n{body}</main>\n<div id=\"tip\" role=\"status\" hidden></div>\n<script>\n{SCRIPT}</script>\n\
         </body>\n</html>\n",
        colors(),
        summary(records, points),
    )
}

fn summary(records: &[&Record], points: &Points<'_>) -> String {
    let count = |mut names: Vec<String>| {
        names.sort_unstable();
        names.dedup();
        names.len()
    };
    let drawn = records.iter().filter(|r| r.result.is_some()).count();
    let meshes = count(records.iter().map(|r| r.subject.mesh.clone()).collect());
    let scenes = count(records.iter().map(|r| r.subject.scene.clone()).collect());
    let methods = count(records.iter().map(|r| words::method(&r.by)).collect());
    format!(
        "{drawn} runs and {} refusals: {methods} methods, {meshes} meshes, {scenes} scenes, and {} to run on; the times of \
         several never share a chart. Times are of warm frames, medians; errors are against references in 64-bit floating point, linear, opacity included. Point \
         at a mark, touch it or step to it by the tabulator and arrow keys to see what it stands for.",
        records.len() - drawn,
        match points.hosts.len() {
            1 => "one machine".into(),
            count => format!("{count} machines"),
        }
    )
}

fn charts(section: &Section) -> String {
    let mut html = String::from("<div class=\"charts\">\n");
    for chart in &section.charts {
        html +=
            &format!("<figure class=\"chart\" id=\"{}\">\n{}</figure>\n", escape(&chart.name), inline(&chart.light));
    }
    html += "</div>\n";
    if !section.left_out.is_empty() {
        let items: String = section.left_out.iter().map(|what| format!("<li>{}</li>\n", escape(what))).collect();
        let count = section.left_out.len();
        html += &format!("<details><summary>Without a chart: {count}</summary>\n<ul>\n{items}</ul></details>\n");
    }
    html
}

fn pictures(strips: &[Strip]) -> String {
    let picture = |what: &str, strip: &Strip, png: &[u8]| {
        let alt = escape(&format!("{what}: {}", strip.title));
        let data = STANDARD.encode(png);
        format!("<div><img alt=\"{alt}\" src=\"data:image/png;base64,{data}\"><span>{what}</span></div>\n")
    };
    let strip = |strip: &Strip| {
        format!(
            "<figure class=\"strip\">\n<figcaption><b>{}</b> {}</figcaption>\n<div class=\"pictures\">\n{}{}{}</div>\n\
             </figure>\n",
            escape(&strip.title),
            escape(&strip.caption),
            picture("reference", strip, &strip.reference),
            picture("drawn", strip, &strip.drawn),
            picture(&format!("difference × {GAIN}"), strip, &strip.difference)
        )
    };
    strips.iter().map(strip).collect()
}

/// The colours of a theme by the names that the page knows them by.
fn named(theme: &Theme) -> impl Iterator<Item = (String, RGBColor)> {
    let fixed = [("paper", theme.paper), ("ink", theme.ink), ("faint", theme.faint), ("grid", theme.grid)];
    let series = (0..).zip(theme.series).map(|(i, color)| (format!("series-{i}"), color));
    fixed.into_iter().map(|(name, color)| (name.to_owned(), color)).chain(series)
}

fn hex(RGBColor(r, g, b): RGBColor) -> String {
    format!("#{r:02X}{g:02X}{b:02X}")
}

fn colors() -> String {
    let list = |theme| named(theme).map(|(name, color)| format!("--{name}: {}; ", hex(color))).collect::<String>();
    let (light, dark) = (list(&LIGHT), list(&DARK));
    format!(":root {{ {light}}}\n@media (prefers-color-scheme: dark) {{ :root {{ {dark}}} }}\n")
}

/// The light chart with the page's colours instead of its own, so that one drawing serves both.
fn inline(svg: &str) -> String {
    let mut svg = svg.replacen(" xmlns=\"http://www.w3.org/2000/svg\"", "", 1);
    for (name, color) in named(&LIGHT) {
        svg = svg.replace(&format!("\"{}\"", hex(color)), &format!("\"var(--{name})\""));
    }
    svg
}
