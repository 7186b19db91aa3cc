//! `tetralux histogram`: how a mesh's volume is spread over a scalar and its gradient magnitude.

use plotters::prelude::RGBColor;
use plotters::style::text_anchor::{HPos, VPos};

use super::args::HistogramArgs;
use super::load;
use super::output::{self, check_file, check_picture};
use super::plot::{self, Axes};
use super::progress::step;
use crate::error::{Error, Result};
use crate::image::{Image, PngEncoding};
use crate::space::Interval;
use crate::tet::{JointHistogram, TetMesh};

/// Decades of the largest bin that are told apart.
const DECADES: f64 = 6.0;
const INK: RGBColor = RGBColor(40, 40, 40);

pub(super) fn run(args: &HistogramArgs) -> anyhow::Result<()> {
    check_picture(&args.output)?;
    if let Some(csv) = &args.csv {
        check_file(csv, &["csv"])?;
    }
    let (mesh, _) = load::tet_mesh(&args.source, args.field.as_deref())?;
    let histogram = step("counting", || JointHistogram::new(&mesh, args.bins.map(|n| n as usize)));
    let image = draw(&mesh, &histogram)?;
    step("writing", || -> Result<()> {
        image.write(&args.output, PngEncoding::Srgb)?;
        match &args.csv {
            Some(path) => output::write_whole(path, &table(&histogram)),
            None => Ok(()),
        }
    })?;
    Ok(())
}

/// One line a bin, scalar fastest.
fn table(histogram: &JointHistogram) -> String {
    let mut text = String::from("scalar,gradient_magnitude,volume\n");
    for (index, volume) in histogram.counts.iter().enumerate() {
        let [s, g] = histogram.bin_center(index % histogram.bins[0], index / histogram.bins[0]);
        text.push_str(&format!("{s},{g},{volume}\n"));
    }
    text
}

fn draw(mesh: &TetMesh, histogram: &JointHistogram) -> Result<Image> {
    let most = histogram.counts.iter().copied().fold(0.0, f64::max);
    if !(most > 0.0 && most.is_finite()) {
        return Err(Error::Mesh("the mesh has no volume to count".into()));
    }
    let y_label = format!("gradient magnitude of {} (data units per length)", mesh.field);
    let axes = Axes {
        frame: [90, 40, 602, 552],
        x: histogram.scalar,
        y: histogram.gradient,
        x_label: &mesh.field,
        y_label: &y_label,
        ink: INK,
    };
    let scale = Axes {
        frame: [690, 40, 710, 552],
        x: Interval { min: 0.0, max: 1.0 },
        y: Interval { min: -DECADES, max: 0.0 },
        x_label: "",
        y_label: "",
        ink: INK,
    };
    let [columns, rows] = histogram.bins;
    let bin = |range: Interval, value: f64, count: usize| {
        (((value - range.min) / range.length() * count as f64) as usize).min(count - 1)
    };
    plot::picture([800, 610], |area| {
        axes.fill(area, |s, g| {
            let volume = histogram.counts[bin(axes.y, g, rows) * columns + bin(axes.x, s, columns)];
            (volume > 0.0).then(|| shade((volume / most).log10()))
        })?;
        axes.draw(area)?;
        scale.fill(area, |_, y| Some(shade(y)))?;
        for decade in 0..=DECADES as i32 {
            let label = if decade == 0 { "fullest bin".into() } else { format!("1e-{decade}") };
            let y = 40 + 512 * decade / DECADES as i32;
            plot::text(area, &label, (716, y), (HPos::Left, VPos::Center), INK)?;
        }
        plot::text(area, "volume", (690, 26), (HPos::Left, VPos::Bottom), INK)
    })
}

/// From pale blue to almost black as `decades` rises from -6 to 0.
fn shade(decades: f64) -> RGBColor {
    const STOPS: [[f64; 3]; 4] = [[222.0, 235.0, 247.0], [107.0, 174.0, 214.0], [33.0, 90.0, 160.0], [8.0, 20.0, 60.0]];
    let at = (1.0 + decades / DECADES).clamp(0.0, 1.0) * 3.0;
    let low = (at as usize).min(2);
    let [r, g, b] = std::array::from_fn(|c| {
        (STOPS[low][c] + (at - low as f64) * (STOPS[low + 1][c] - STOPS[low][c])).round() as u8
    });
    RGBColor(r, g, b)
}
