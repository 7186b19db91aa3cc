//! Runs a plan: each contender on each subject, timed warm and compared with the reference, a record a line.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use indicatif::ProgressBar;

use super::args::{ReportArgs, RunArgs};
use super::machine::{go_on_afresh, this_machine, used};
use super::plan::{Choice, Plan, Shot, shot};
use super::strips::picture_name;
use super::{peers, subject};
use crate::cli::args::{ChoiceArgs, Device, IntegralChoice, Method, name_of};
use crate::cli::device::{self, Wish};
use crate::cli::output;
use crate::error::{Error, Result};
use crate::image::{Comparison, Image, PngEncoding};
use crate::oracle::Progress;
use crate::renderer::{Frame, PassTime, Renderer, TOLERANCE, choose_integral};
use crate::report::record::{Contender, Deviation, Machine, Measured, Pass, Record, Spread, Subject};
use crate::tet::{Domain as _, TetMesh};

/// Runs the plan in the file `path`; `name`: of its folder of results, where none is asked for.
pub(super) fn run(path: &Path, args: &RunArgs) -> anyhow::Result<()> {
    let plan = Plan::read(path)?;
    let name = path.file_stem().unwrap_or_default();
    let folder = args.output.clone().unwrap_or_else(|| Path::new("out/bench").join(name));
    let file = RecordFile::open(&folder)?;
    let mut run =
        Run { plan: &plan, args, source: path.parent().unwrap_or(Path::new("")), folder, file, machines: Vec::new() };
    let jobs = run.jobs();
    let bar = subject::bar(jobs);
    for mesh in &plan.mesh {
        run.mesh(mesh, &bar)?;
    }
    bar.finish_and_clear();
    output::note(&format!("{} records in {}", run.file.records.len(), run.file.path.display()));
    if let Some(peers) = &args.for_peers {
        output::note(&format!("subjects for other programs in {}", peers.display()));
    }
    let (records, peers) = (vec![run.file.path], args.peers.clone());
    super::report::run(&ReportArgs { records, peers, output: run.folder })
}

/// Records that are there, and where new ones go.
struct RecordFile {
    path: PathBuf,
    records: Vec<Record>,
}

impl RecordFile {
    /// Opens `records.jsonl` of a folder that is made if need be; what a run that was cut off left of its last line goes.
    fn open(folder: &Path) -> Result<Self> {
        let path = folder.join("records.jsonl");
        subject::make_folder_of(&path)?;
        let records = match std::fs::read_to_string(&path) {
            Ok(text) => {
                let whole = text.rfind('\n').map_or(0, |end| end + 1);
                if whole < text.len() {
                    output::write_whole(&path, &text[..whole])?;
                }
                Record::read(&path)?
            }
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => Vec::new(),
            Err(e) => return Err(Error::io(&path, e)),
        };
        Ok(Self { path, records })
    }

    fn add(&mut self, record: Record) -> Result<()> {
        let line = serde_json::to_string(&record).map_err(|e| Error::write(&self.path, e))? + "\n";
        let append = || std::fs::OpenOptions::new().create(true).append(true).open(&self.path);
        output::whole(|| append().and_then(|mut file| file.write_all(line.as_bytes())))
            .map_err(|e| Error::write(&self.path, e))?;
        self.records.push(record);
        Ok(())
    }

    /// Whether the same was measured by the same program on the same machine: of a source with changes nobody knows.
    fn has(&self, subject: &Subject, by: &Contender, machine: &Machine) -> bool {
        let same = |r: &Record| (&r.subject, &r.by, &r.machine) == (subject, by, machine);
        !machine.commit.ends_with("-dirty") && self.records.iter().any(same)
    }
}

struct Run<'a> {
    plan: &'a Plan,
    args: &'a RunArgs,
    /// Folder of the plan.
    source: &'a Path,
    folder: PathBuf,
    file: RecordFile,
    machines: Vec<(Device, Machine)>,
}

/// A subject that is ready to be drawn.
struct Scenery {
    subject: Subject,
    shot: Shot,
    truth: Image,
}

impl Run<'_> {
    /// Views of all scenes, in all sizes.
    fn views(&self) -> impl Iterator<Item = (usize, usize, [u32; 2])> {
        let plan = self.plan;
        (0..plan.scene.len()).flat_map(move |scene| {
            (0..plan.view.len()).flat_map(move |view| plan.sizes.iter().map(move |&size| (scene, view, size)))
        })
    }

    fn choices(&self, mesh: &str, (scene, view, size): (usize, usize, [u32; 2])) -> Vec<Choice> {
        self.plan.choices(mesh, &self.plan.scene[scene].name, &self.plan.view[view].name, size)
    }

    fn jobs(&self) -> u64 {
        let of_mesh = |mesh: &str| self.views().map(|view| self.choices(mesh, view).len() as u64).sum::<u64>();
        self.plan.mesh.iter().map(|mesh| of_mesh(&mesh.name)).sum()
    }

    /// Measures everything that draws a mesh.
    fn mesh(&mut self, entry: &super::plan::MeshEntry, bar: &ProgressBar) -> anyhow::Result<()> {
        let views: Vec<_> = self.views().filter(|&view| !self.choices(&entry.name, view).is_empty()).collect();
        if views.is_empty() {
            return Ok(());
        }
        bar.set_message(format!("reading {}", entry.name));
        let mesh = self.plan.load(entry, self.args.data.as_deref())?;
        let mesh_hash = subject::mesh_hash(&mesh);
        let mut sceneries = Vec::new();
        let mut choices: Vec<Choice> = Vec::new();
        for &(scene, view, size) in &views {
            let (scene, view) = (&self.plan.scene[scene], &self.plan.view[view]);
            bar.set_message(format!("reference of {}, {}, {}", entry.name, scene.name, view.name));
            let shot = shot(scene, view, size, &mesh)?;
            let hash = subject::hash(mesh_hash, &shot, size);
            let truth = subject::truth(&self.folder, &hash, &mesh, &subject::frame(&shot, size))?;
            let subject = Subject {
                mesh: entry.name.clone(),
                scene: scene.name.clone(),
                view: view.name.clone(),
                size,
                tetrahedra: mesh.tet_count(),
                hash,
            };
            if let Some(folder) = &self.args.for_peers {
                peers::write(folder, &subject, &mesh, &shot, &truth)?;
            }
            sceneries.push(Scenery { subject, shot, truth });
        }
        for &view in &views {
            for choice in self.choices(&entry.name, view) {
                if !choices.contains(&choice) {
                    choices.push(choice);
                }
            }
        }
        for choice in choices {
            let asked = views.iter().zip(&sceneries);
            let asked = asked.filter(|(view, _)| self.choices(&entry.name, **view).contains(&choice)).map(|(_, s)| s);
            let asked: Vec<&Scenery> = asked.collect();
            self.contender(&mesh, choice, &asked, bar)?;
        }
        Ok(())
    }

    /// Measures one contender on all its pictures of a mesh.
    fn contender(
        &mut self,
        mesh: &Arc<TetMesh>,
        choice: Choice,
        asked: &[&Scenery],
        bar: &ProgressBar,
    ) -> anyhow::Result<()> {
        let by = contender_of(choice);
        let mut ready: Option<Ready> = None;
        let machine = self.machine(choice.device)?;
        for scenery in asked {
            bar.set_message(format!("{}, {}: {}", scenery.subject.mesh, scenery.subject.scene, label(&by)));
            bar.inc(1);
            if self.file.has(&scenery.subject, &by, &machine) {
                continue;
            }
            let made = match ready.take() {
                Some(ready) => Ok(ready),
                None => make(mesh, choice, scenery),
            };
            let measured = made.and_then(|mut made| {
                let frame = subject::frame(&scenery.shot, scenery.subject.size);
                let measured = made.measure(choice, &frame, self.plan.repeats, &scenery.truth)?;
                // Software adapters keep some of what they drew with until the device goes. What is chosen is chosen for a scene.
                ready = (choice.device != Device::Software && choice.method != Method::Auto).then_some(made);
                Ok(measured)
            });
            let (result, refused) = match measured {
                Ok((measured, image)) => {
                    self.keep_picture(&scenery.subject, &by, &image)?;
                    (Some(measured), None)
                }
                // What cannot be done is a result, too.
                Err(error) => (None, Some(error.to_string())),
            };
            let (subject, by) = (scenery.subject.clone(), by.clone());
            self.file.add(Record { subject, by, machine: machine.clone(), result, refused })?;
            if choice.device == Device::Software {
                go_on_afresh(&machine)
                    .map_err(|e| Error::Device(format!("the run cannot go on in a new process: {e}")))?;
            }
        }
        Ok(())
    }

    /// This one, with what a device is called there.
    fn machine(&mut self, device: Device) -> Result<Machine> {
        if let Some((_, machine)) = self.machines.iter().find(|(known, _)| *known == device) {
            return Ok(machine.clone());
        }
        let machine = this_machine(self.source, &device::adapter(device)?);
        self.machines.push((device, machine.clone()));
        Ok(machine)
    }

    fn keep_picture(&self, subject: &Subject, by: &Contender, image: &Image) -> Result<()> {
        let path = self.folder.join("pictures").join(&subject.hash).join(picture_name(by) + ".exr");
        subject::make_folder_of(&path)?;
        output::whole(|| image.write(&path, PngEncoding::Linear))
    }
}

fn contender_of(choice: Choice) -> Contender {
    Contender {
        program: "tetralux".into(),
        device: name_of(choice.device),
        method: name_of(choice.method),
        integral: choice.integral.to_string(),
        order: name_of(choice.order),
    }
}

fn label(by: &Contender) -> String {
    format!("{} {} {} {}", by.device, by.method, by.integral, by.order)
}

/// A renderer, and what making it took.
struct Ready {
    renderer: Box<dyn Renderer>,
    why: Option<String>,
    is_reference: bool,
    made: Duration,
}

fn make(mesh: &Arc<TetMesh>, choice: Choice, scenery: &Scenery) -> Result<Ready> {
    let Choice { device, method, integral, order } = choice;
    let settings = ChoiceArgs::of(method, order, integral).settings();
    let frame = subject::frame(&scenery.shot, scenery.subject.size);
    let wish = Wish { device, settings, frame: &frame, shared: None };
    let unheard: Progress = Arc::new(|_| true);
    let start = Instant::now();
    let chosen = device::renderer(mesh, &wish, &unheard)?;
    let made = start.elapsed();
    Ok(Ready { renderer: chosen.renderer, why: chosen.why, is_reference: chosen.is_reference, made })
}

impl Ready {
    /// One picture compared, one with its passes timed, and `repeats` frames.
    fn measure(
        &mut self,
        choice: Choice,
        frame: &Frame<'_>,
        repeats: usize,
        truth: &Image,
    ) -> Result<(Measured, Image)> {
        let renderer = &mut *self.renderer;
        let start = Instant::now();
        let integral = match choice.integral {
            IntegralChoice::Auto if !self.is_reference => Some(choose_integral(renderer, frame, TOLERANCE)?),
            _ => None,
        };
        let first = renderer.render(frame, false)?;
        let prepare = self.made + start.elapsed();
        let stats = renderer.render(frame, true)?.stats;
        let before = used();
        let times = (0..repeats).map(|_| renderer.render_only(frame)).collect::<Result<Vec<_>>>()?;
        let after = used();
        let comparison = Comparison::new(&first.image, truth)?;
        let error = Deviation::new(&comparison)
            .ok_or_else(|| Error::Device(format!("{} pixels are not finite", comparison.not_finite)))?;
        let frame_seconds = Spread::new(&times).ok_or_else(|| Error::Asked("no frame was timed".into()))?;
        let cpu_seconds =
            before.zip(after).map(|((before, _), (after, _))| (after - before).as_secs_f64() / repeats as f64);
        let chosen: Vec<String> = integral
            .map(|chosen| format!("{}: {}", chosen.integral, chosen.why))
            .into_iter()
            .chain(self.why.clone())
            .chain(Some(stats.order).filter(|order| !order.is_empty()))
            .collect();
        let measured = Measured {
            frame_seconds,
            cpu_seconds,
            passes: passes(&stats.passes),
            drawn: stats.cells.last().map(|(_, count)| *count),
            prepare_seconds: Some(prepare.as_secs_f64()),
            device_bytes: Some(stats.buffers.iter().map(|b| b.bytes).sum()).filter(|&bytes| bytes > 0),
            peak_bytes: after.map(|(_, bytes)| bytes),
            chosen: Some(chosen.join("; ")).filter(|text| !text.is_empty()),
            error,
        };
        Ok((measured, first.image))
    }
}

/// Times of equal passes added up, in the order in which they first ran.
fn passes(timed: &[PassTime]) -> Vec<Pass> {
    let mut passes: Vec<Pass> = Vec::new();
    for PassTime { pass, time, .. } in timed {
        let seconds = time.as_secs_f64();
        match passes.iter_mut().find(|known| known.name == *pass) {
            Some(known) => known.seconds += seconds,
            None => passes.push(Pass { name: pass.clone(), seconds }),
        }
    }
    passes
}
