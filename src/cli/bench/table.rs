//! The page's tables: all runs, what was refused, and the machines.

use super::words::{self, escape};
use crate::report::record::{Machine, Measured, Record};

/// A cell: what is shown, and the number that it is sorted by.
enum Cell {
    Text(String),
    Number(String, f64),
}

use Cell::{Number, Text};

/// Machines as they first appear: figures name them by their place, from 1.
pub(super) fn machines<'a>(records: &[&'a Record]) -> Vec<&'a Machine> {
    let mut machines: Vec<&Machine> = Vec::new();
    for record in records {
        if !machines.contains(&&record.machine) {
            machines.push(&record.machine);
        }
    }
    machines
}

/// Heads of what [`whom`] tells.
const WHOM: [&str; 10] =
    ["mesh", "scene", "view", "size", "tetrahedra", "program", "device", "method", "integral", "order"];

/// Every run that was drawn.
pub(super) fn runs(records: &[&Record]) -> String {
    let machines = machines(records);
    let heads = [
        &WHOM[..],
        &[
            "ms",
            "min",
            "max",
            "frames",
            "RMSE",
            "PSNR, dB",
            "max error",
            "99.9 %",
            "above 1/255",
            "drawn",
            "device memory",
            "peak memory",
            "machine",
        ],
    ]
    .concat();
    let row = |record: &&Record| Some(run(record, record.result.as_ref()?, &machines));
    table("runs", "All runs", &heads, records.iter().filter_map(row))
}

fn run(record: &Record, measured: &Measured, machines: &[&Machine]) -> Vec<Cell> {
    let mut cells = whom(record);
    let time = measured.frame_seconds;
    let error = measured.error;
    cells.extend([time.median, time.min, time.max].map(|s| Number(words::milliseconds(s), s)));
    cells.push(Number(time.frames.to_string(), time.frames as f64));
    cells.push(Number(words::short(error.rmse), error.rmse));
    cells.push(Number(words::decibels(error.psnr), error.psnr.unwrap_or(f64::INFINITY)));
    cells.extend([error.max, error.percentile_99_9].map(|e| Number(words::short(e), e)));
    cells.push(Number(format!("{} %", words::short(100.0 * error.above_8_bit)), error.above_8_bit));
    let known = |count: Option<u64>, shown: fn(u64) -> String| match count {
        Some(count) => Number(shown(count), count as f64),
        None => Number(String::new(), -1.0),
    };
    cells.push(known(measured.drawn, words::grouped));
    cells.extend([measured.device_bytes, measured.peak_bytes].map(|b| known(b, words::bytes)));
    cells.push(place(record, machines));
    cells
}

/// What was not drawn, and why.
pub(super) fn refused(records: &[&Record]) -> String {
    let machines = machines(records);
    let heads = [&WHOM[..], &["why", "machine"]].concat();
    let row = |record: &&Record| {
        let mut cells = whom(record);
        cells.push(Text(record.refused.clone()?));
        cells.push(place(record, &machines));
        Some(cells)
    };
    table("refused", "Refused runs", &heads, records.iter().filter_map(row))
}

/// Where and by what the figures were made.
pub(super) fn provenance(records: &[&Record]) -> String {
    let heads = ["machine", "programs", "processor", "threads", "memory", "system", "adapter", "commit", "runs"];
    let row = |(i, machine): (usize, &&Machine)| {
        let here: Vec<&&Record> = records.iter().filter(|r| r.machine == **machine).collect();
        let mut programs: Vec<&str> = here.iter().map(|r| r.by.program.as_str()).collect();
        programs.sort_unstable();
        programs.dedup();
        vec![
            Number((i + 1).to_string(), i as f64),
            Text(programs.join(", ")),
            Text(machine.processor.clone()),
            Number(machine.threads.to_string(), machine.threads as f64),
            Number(words::bytes(machine.memory_bytes), machine.memory_bytes as f64),
            Text(machine.system.clone()),
            Text(machine.adapter.clone()),
            Text(machine.commit.clone()),
            Number(here.len().to_string(), here.len() as f64),
        ]
    };
    table("machines", "Machines", &heads, machines(records).iter().enumerate().map(row))
}

fn whom(record: &Record) -> Vec<Cell> {
    let (s, by) = (&record.subject, &record.by);
    let mut cells: Vec<Cell> = [&s.mesh, &s.scene, &s.view].map(|t| Text(t.clone())).into();
    cells.push(Number(words::size(s), s.size.map(f64::from).iter().product()));
    cells.push(Number(words::grouped(s.tetrahedra), s.tetrahedra as f64));
    cells.extend([&by.program, &by.device, &by.method, &by.integral, &by.order].map(|t| Text(t.clone())));
    cells
}

fn place(record: &Record, machines: &[&Machine]) -> Cell {
    let at = machines.iter().position(|m| **m == record.machine).unwrap_or(0);
    Number((at + 1).to_string(), at as f64)
}

/// A table that sorts by its heads, in a box that scrolls.
fn table(id: &str, label: &str, heads: &[&str], rows: impl Iterator<Item = Vec<Cell>>) -> String {
    let mut html = format!(
        "<div class=\"scroll\" role=\"region\" aria-label=\"{label}\" tabindex=\"0\"><table id=\"{id}\"><thead><tr>"
    );
    let rows: Vec<Vec<Cell>> = rows.collect();
    for (i, head) in heads.iter().enumerate() {
        let is_number = rows.first().is_some_and(|row| matches!(row[i], Number(..)));
        let class = if is_number { " class=\"number\"" } else { "" };
        html += &format!(
            "<th scope=\"col\"{class} aria-sort=\"none\"><button type=\"button\">{}</button></th>",
            escape(head)
        );
    }
    html += "</tr></thead>\n<tbody>\n";
    for row in rows {
        html += "<tr>";
        for cell in row {
            html += &match cell {
                Text(text) => format!("<td>{}</td>", escape(&text)),
                Number(text, value) => format!("<td data-v=\"{value}\">{}</td>", escape(&text)),
            };
        }
        html += "</tr>\n";
    }
    html + "</tbody></table></div>\n"
}
