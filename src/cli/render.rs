//! `tetralux render`: from a mesh file to a picture.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::args::{IntegralChoice, RenderArgs};
use super::device::{Chosen, Wish};
use super::job::RenderJob;
use super::load::Wanted;
use super::stats::{Report, Timing};
use super::{device, legend, load, output, progress};
use crate::error::Result;
use crate::oracle::Progress;
use crate::renderer::{Frame, OrderMethod, Renderer, choose_integral};
use crate::tet::Domain;

pub(super) fn run(args: &RenderArgs) -> anyhow::Result<()> {
    let job = RenderJob::new(args)?;
    let field = job.scene.field.as_deref();
    let start = Instant::now();
    let wanted = match args.choices.settings().order {
        OrderMethod::Structured => Wanted::Grid,
        // A box cuts through voxels: into tetrahedra, then.
        OrderMethod::Auto if job.scene.clip.is_none() => Wanted::GridIfPossible,
        _ => Wanted::Mesh,
    };
    let takes_grids = || device::takes_grids(args.device, args.choices.settings(), &job.scene.optics);
    match load::domain(&args.source, field, wanted, takes_grids)? {
        load::Domain::Grid(grid) => {
            let grid = Arc::new(grid);
            let make = |wish: &Wish<'_>, _: &Progress| device::grid_renderer(&grid, wish, job.scene.clip.as_ref());
            draw(args, &job, &*grid, start.elapsed(), make)
        }
        load::Domain::Mesh(mesh) => {
            let mesh = Arc::new(mesh);
            let part = match &job.scene.clip {
                Some(bounds) => Arc::new(progress::step("clipping", || mesh.clipped_to(bounds))?),
                None => Arc::clone(&mesh),
            };
            // Cameras, units and legends are the whole mesh's.
            draw(args, &job, &*mesh, start.elapsed(), |wish, heard| device::renderer(&part, wish, heard))
        }
    }
}

/// Makes a renderer, draws, and tells. `load`: what the mesh took.
fn draw(
    args: &RenderArgs,
    job: &RenderJob,
    mesh: &dyn Domain,
    load: Duration,
    make: impl FnOnce(&Wish<'_>, &Progress) -> Result<Chosen>,
) -> anyhow::Result<()> {
    let (camera, transfer) = job.scene.resolve(mesh)?;
    let bar = progress::bar("rendering");
    let followed = bar.clone();
    let heard: Progress = Arc::new(move |share| {
        followed.set_position((1000.0 * share) as u64);
        true
    });
    let start = Instant::now();
    let settings = args.choices.settings();
    let background = job.scene.premultiplied_background();
    let frame =
        Frame { camera: &camera, transfer: &transfer, optics: &job.scene.optics, size: job.scene.size, background };
    let wish = Wish { device: args.device, settings, frame: &frame, shared: None };
    let Chosen { mut renderer, note, why, is_reference } = progress::step("preparing", || make(&wish, &heard))?;
    let prepare = start.elapsed();
    let timed = args.explain || args.stats.is_some();
    let integral = match args.choices.integral {
        IntegralChoice::Auto if !is_reference => {
            let choose = || choose_integral(&mut *renderer, &frame, args.choices.tolerance);
            Some(progress::step("choosing", choose)?)
        }
        _ => None,
    };
    let mut rendered = progress::step_with(bar, || renderer.render(&frame, timed))?;
    // The picture above was the warm-up: passes are timed once more.
    if !rendered.stats.passes.is_empty() {
        rendered.stats = renderer.render(&frame, timed)?.stats;
    }
    let integral = integral.map(|chosen| format!("{} is the integral: {}", chosen.integral, chosen.why));
    rendered.stats.notes.splice(0..0, note.into_iter().chain(integral));
    let frames = if timed || args.repeat > 1 { time_frames(&mut *renderer, &frame, args.repeat)? } else { Vec::new() };
    let image = if args.legend { legend::beside(&rendered.image, mesh, &transfer)? } else { rendered.image };
    progress::step("writing", || output::whole(|| image.write(&args.output, job.encoding)))?;
    for text in &rendered.stats.notes {
        output::note(&format!("note: {text}"));
    }
    if timed || args.repeat > 1 {
        let timing = Timing { load, prepare, frames };
        let report = Report::new(args, mesh, job.scene.size, &rendered.stats, &timing).because(why);
        if args.explain {
            output::note(&report.explain());
        } else if args.stats.is_none() {
            output::note(&report.summary());
        }
        if args.stats.is_some() {
            output::say(&serde_json::to_string(&report)?)?;
        }
    }
    Ok(())
}

fn time_frames(renderer: &mut dyn Renderer, frame: &Frame<'_>, count: u32) -> anyhow::Result<Vec<Duration>> {
    let frames = progress::step("timing", || (0..count).map(|_| renderer.render_only(frame)).collect::<Result<_>>())?;
    Ok(frames)
}
