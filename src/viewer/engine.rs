//! Pictures, made beside the window: the newest wish is rendered, coarse first while the camera moves.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::background;
use super::watch::{Wake, Watch};
use crate::cli::args::{ChoiceArgs, Device, IntegralChoice, Method, Order};
use crate::cli::device::{self, Chosen, Wish};
use crate::error::{Error, Result};
use crate::gpu::Gpu;
use crate::image::Image;
use crate::renderer::{Frame, Renderer, SegmentIntegral, choose_integral};
use crate::scene::{Camera, Optics, TransferFunction};
use crate::tet::TetMesh;

/// What a picture may take while the camera moves.
const PATIENCE: Duration = Duration::from_millis(60);
/// The coarsest pictures have a pixel for so many along a side.
const COARSEST: u32 = 8;
/// Software adapters keep what they drew with until the device goes.
const FRAMES_OF_A_DEVICE: u32 = 64;

/// How a picture is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct How {
    /// Where.
    pub(crate) device: Device,
    /// The command line's words for the rest.
    pub(crate) choices: ChoiceArgs,
}

impl Default for How {
    fn default() -> Self {
        Self { device: Device::Auto, choices: ChoiceArgs::of(Method::Auto, Order::Auto, IntegralChoice::Auto) }
    }
}

/// One of the pictures that are shown together.
#[derive(Clone, Debug, PartialEq)]
pub struct Side {
    /// Data units.
    pub transfer: TransferFunction,
    /// How it is made.
    pub how: How,
}

/// What is to be seen.
#[derive(Clone)]
pub struct Wanted {
    /// Of what.
    pub mesh: Arc<TetMesh>,
    /// One or two.
    pub sides: Vec<Side>,
    /// From where.
    pub camera: Camera,
    /// Emission, lighting, silhouettes.
    pub optics: Optics,
    /// Pixels.
    pub size: [u32; 2],
    /// Linear, premultiplied.
    pub background: [f32; 4],
    /// Coarse pictures do.
    pub is_moving: bool,
}

impl PartialEq for Wanted {
    fn eq(&self, other: &Self) -> bool {
        let key = |w: &Self| (w.camera, w.optics, w.size, w.background, w.is_moving);
        Arc::ptr_eq(&self.mesh, &other.mesh) && key(self) == key(other) && self.sides == other.sides
    }
}

/// Pictures of a wish.
#[derive(Clone, Debug)]
pub struct Shown {
    /// One a side, of equal sizes.
    pub images: Vec<Image>,
    /// Pixels of the wish along a side of one of these.
    pub step: u32,
    /// What one picture took, seconds, without what was made ready for it.
    pub seconds: f64,
    /// How they were made.
    pub notes: Vec<String>,
    /// No better ones follow.
    pub is_last: bool,
}

struct Slot {
    /// With its number.
    wanted: Mutex<Option<(u64, Wanted)>>,
    watch: Watch,
    wake: Wake,
    changed: Condvar,
    is_closed: AtomicBool,
}

/// The thread that renders.
pub struct Engine {
    slot: Arc<Slot>,
    results: Receiver<(u64, Result<Shown>)>,
    last: Option<Wanted>,
    /// The last wish's number.
    asked: u64,
    /// The thread has, and that was told.
    has_ended: bool,
}

impl Engine {
    /// `shared`: the window's device, where pictures are made on it, too; `wake` is called for each result.
    ///
    /// # Errors
    /// No thread can be made.
    pub fn new(shared: Option<Gpu>, wake: Wake) -> Result<Self> {
        let slot = Arc::new(Slot {
            wanted: Mutex::new(None),
            watch: Watch::default(),
            wake,
            changed: Condvar::new(),
            is_closed: AtomicBool::new(false),
        });
        let (sender, results) = channel();
        let taken = Arc::clone(&slot);
        // Renderers do not go from thread to thread.
        let work = move || {
            let worker = Worker {
                slot: taken,
                sender,
                shared,
                ready: Vec::new(),
                last_choices: [None; 2],
                seconds_per_pixel: 0.0,
            };
            worker.run();
        };
        let pool = background::pool()?;
        std::thread::spawn(move || pool.install(work));
        Ok(Self { slot, results, last: None, asked: 0, has_ended: false })
    }

    /// Asks for pictures; those that were asked for before are given up. Whether they are others.
    pub fn want(&mut self, wanted: Wanted) -> bool {
        if self.last.as_ref() == Some(&wanted) {
            return false;
        }
        self.last = Some(wanted.clone());
        self.asked += 1;
        let mut slot = self.slot.wanted.lock().unwrap_or_else(PoisonError::into_inner);
        *slot = Some((self.asked, wanted));
        self.slot.watch.give_up();
        drop(slot);
        self.slot.changed.notify_one();
        true
    }

    /// How far the picture is that is being made, 0 to 1, where that is known.
    pub fn progress(&self) -> Option<f64> {
        self.slot.watch.share().filter(|_| !self.slot.watch.is_given_up())
    }

    /// Gives up the picture that is being made, if that can be: nothing comes of it.
    pub fn cancel(&self) {
        self.slot.watch.give_up();
    }

    /// What was asked for last.
    pub fn last(&self) -> Option<&Wanted> {
        self.last.as_ref()
    }

    /// What has come since the last call, and whether it is of the last wish.
    pub fn results(&mut self) -> Vec<(bool, Result<Shown>)> {
        let mut all = Vec::new();
        loop {
            match self.results.try_recv() {
                Ok((number, result)) => all.push((number == self.asked, result)),
                Err(TryRecvError::Disconnected) if !self.has_ended => {
                    self.has_ended = true;
                    let text = "what renders has ended: save the scene, and open the window again";
                    all.push((true, Err(Error::Device(text.into()))));
                }
                Err(_) => return all,
            }
        }
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        self.slot.is_closed.store(true, Ordering::Relaxed);
        self.slot.watch.give_up();
        self.slot.changed.notify_one();
    }
}

/// A renderer that is kept, and for what.
struct Ready {
    mesh: Arc<TetMesh>,
    how: How,
    side: usize,
    renderer: Box<dyn Renderer>,
    /// Its method was.
    is_chosen: bool,
    is_reference: bool,
    notes: Vec<String>,
    /// The function that the method was chosen for.
    chosen_for: TransferFunction,
    /// The function that the integral was chosen for, if it was.
    integral_for: Option<TransferFunction>,
    integral_note: String,
    frames: u32,
}

/// The integral that a side was last drawn with, by choice.
#[derive(Clone, Copy)]
struct LastChoice {
    how: How,
    integral: SegmentIntegral,
}

struct Worker {
    slot: Arc<Slot>,
    sender: Sender<(u64, Result<Shown>)>,
    shared: Option<Gpu>,
    ready: Vec<Ready>,
    last_choices: [Option<LastChoice>; 2],
    seconds_per_pixel: f64,
}

impl Worker {
    fn run(mut self) {
        while let Some((number, wanted)) = self.next() {
            for step in self.steps(&wanted) {
                if self.is_superseded() {
                    break;
                }
                self.slot.watch.rewind();
                let result = self.render(&wanted, step);
                if result.is_err() && self.slot.watch.is_given_up() {
                    break;
                }
                let has_failed = result.is_err();
                if let Err(error) = &result {
                    // A lost device is opened again the next time, and not the window's.
                    self.ready.clear();
                    self.shared = self.shared.take().filter(|_| !matches!(error, Error::Device(_)));
                }
                if self.sender.send((number, result)).is_err() {
                    return;
                }
                (self.slot.wake)();
                if has_failed {
                    break;
                }
            }
        }
    }

    fn next(&self) -> Option<(u64, Wanted)> {
        let mut wanted = self.slot.wanted.lock().unwrap_or_else(PoisonError::into_inner);
        loop {
            if self.slot.is_closed.load(Ordering::Relaxed) {
                return None;
            }
            if let Some(wanted) = wanted.take() {
                // While the slot is held: whoever wants something else gives it up after this.
                self.slot.watch.begin();
                return Some(wanted);
            }
            wanted = self.slot.changed.wait(wanted).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn is_superseded(&self) -> bool {
        let wanted = self.slot.wanted.lock().unwrap_or_else(PoisonError::into_inner);
        wanted.is_some() || self.slot.is_closed.load(Ordering::Relaxed)
    }

    /// Pixels along a side of a picture's: coarse ones as fast as a camera moves, then all of them.
    fn steps(&self, wanted: &Wanted) -> Vec<u32> {
        let pixels = f64::from(wanted.size[0]) * f64::from(wanted.size[1]) * wanted.sides.len() as f64;
        let share = self.seconds_per_pixel * pixels / PATIENCE.as_secs_f64();
        let coarse = match self.seconds_per_pixel > 0.0 {
            true => (share.sqrt().ceil().max(1.0) as u32).next_power_of_two().min(COARSEST),
            // How long pictures take is not known yet.
            false => COARSEST,
        };
        match (wanted.is_moving, coarse) {
            (true, _) => vec![coarse],
            (false, 1) => vec![1],
            (false, _) => vec![coarse, 1],
        }
    }

    fn render(&mut self, wanted: &Wanted, step: u32) -> Result<Shown> {
        self.ready.retain(|ready| Arc::ptr_eq(&ready.mesh, &wanted.mesh) && ready.side < wanted.sides.len());
        let size = wanted.size.map(|n| n.div_ceil(step).max(1));
        let (mut images, mut notes, mut seconds) = (Vec::new(), Vec::new(), 0.0);
        for (number, side) in wanted.sides.iter().enumerate() {
            let frame = Frame {
                camera: &wanted.camera,
                transfer: &side.transfer,
                optics: &wanted.optics,
                size,
                background: wanted.background,
            };
            let ready = self.ready(wanted, number, side, &frame, wanted.is_moving || step > 1)?;
            let start = Instant::now();
            let rendered = ready.renderer.render(&frame, false)?;
            seconds += start.elapsed().as_secs_f64() / wanted.sides.len() as f64;
            ready.frames += 1;
            images.push(rendered.image);
            let mut of_side = ready.notes.clone();
            of_side.extend(Some(ready.integral_note.clone()).filter(|note| !note.is_empty()));
            of_side.extend(rendered.stats.notes);
            of_side.push(format!("on {}", rendered.stats.adapter));
            notes.push(of_side.join("; "));
        }
        // A renderer's first frame does not tell how long frames take.
        if self.ready.iter().all(|ready| ready.frames > 1) {
            let pixels = f64::from(size[0]) * f64::from(size[1]);
            self.seconds_per_pixel = seconds / pixels;
        }
        Ok(Shown { images, step, seconds, notes, is_last: step == 1 })
    }

    /// A renderer of a side; `is_coarse`: of a picture that another one follows.
    fn ready(
        &mut self,
        wanted: &Wanted,
        number: usize,
        side: &Side,
        frame: &Frame<'_>,
        is_coarse: bool,
    ) -> Result<&mut Ready> {
        let is_fit = |ready: &Ready| {
            // Whether cells or rays are cheaper depends on the function where software rasterises.
            let is_chosen = ready.is_chosen && side.how.device == Device::Software && !wanted.is_moving;
            let is_worn = side.how.device == Device::Software && ready.frames >= FRAMES_OF_A_DEVICE;
            ready.how == side.how && !is_worn && !(is_chosen && ready.chosen_for != side.transfer)
        };
        if let Some(at) = self.ready.iter().position(|ready| ready.side == number)
            && !is_fit(&self.ready[at])
        {
            self.ready.remove(at);
        }
        let at = match self.ready.iter().position(|ready| ready.side == number) {
            Some(at) => at,
            None => {
                self.ready.push(self.make(wanted, number, side, frame)?);
                self.ready.len() - 1
            }
        };
        let ready = &mut self.ready[at];
        let chooses = side.how.choices.integral == IntegralChoice::Auto && !ready.is_reference;
        let is_new = ready.integral_for.as_ref() != Some(&side.transfer);
        // While something is being changed, and before a picture in full, the last choice does, of a renderer before this
        // one, too.
        let last = self.last_choices.get(number).copied().flatten().filter(|last| last.how == side.how);
        let is_enough = is_coarse && (ready.integral_for.is_some() || last.is_some());
        if chooses && is_new && !is_enough {
            let chosen = choose_integral(&mut *ready.renderer, frame, side.how.choices.tolerance)?;
            ready.integral_for = Some(side.transfer.clone());
            ready.integral_note = format!("{}: {}", chosen.integral, chosen.why);
            if let Some(last) = self.last_choices.get_mut(number) {
                *last = Some(LastChoice { how: side.how, integral: chosen.integral });
            }
        } else if let Some(last) = last.filter(|_| chooses && ready.integral_for.is_none()) {
            ready.renderer.set_integral(last.integral);
        }
        Ok(ready)
    }

    fn make(&self, wanted: &Wanted, number: usize, side: &Side, frame: &Frame<'_>) -> Result<Ready> {
        let wish = Wish {
            device: side.how.device,
            settings: side.how.choices.settings(),
            frame,
            shared: self.shared.as_ref(),
        };
        let Chosen { renderer, note, why, is_reference } =
            device::renderer(&wanted.mesh, &wish, &self.slot.watch.progress(Arc::clone(&self.slot.wake)))?;
        Ok(Ready {
            mesh: Arc::clone(&wanted.mesh),
            how: side.how,
            side: number,
            renderer,
            is_chosen: why.is_some(),
            is_reference,
            notes: note.into_iter().chain(why).collect(),
            chosen_for: side.transfer.clone(),
            integral_for: None,
            integral_note: String::new(),
            frames: 0,
        })
    }
}
