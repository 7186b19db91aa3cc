//! Records gathered into the points of charts: one contender on one mesh under one scene at one size, over all views.
//!
//! Times of different machines never meet in one chart.

use std::collections::BTreeMap;

use crate::report::record::{Contender, Deviation, Machine, Measured, Record, Spread, Subject};

/// What a chart shows together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Group<'a> {
    pub mesh: &'a str,
    pub scene: &'a str,
    pub size: [u32; 2],
    /// Place in [`Points::hosts`].
    pub host: usize,
}

/// A contender in a group.
#[derive(Debug)]
pub(super) struct Point<'a> {
    pub group: Group<'a>,
    /// Of its first view.
    pub subject: &'a Subject,
    pub by: &'a Contender,
    pub adapter: &'a str,
    pub views: usize,
    /// The median of the views' medians; the shortest and the longest of all frames.
    pub seconds: Spread,
    /// The worst of the views, number by number.
    pub error: Deviation,
    /// On the device, or else of the process; the largest.
    pub bytes: Option<u64>,
    /// Over all views, seconds; in the order of the passes.
    pub passes: Vec<(&'a str, f64)>,
}

/// All of them, in the order of groups and contenders.
#[derive(Debug)]
pub(super) struct Points<'a> {
    pub points: Vec<Point<'a>>,
    /// Processors and their threads: what makes times comparable, whatever adapters are plugged in.
    pub hosts: Vec<(&'a str, usize)>,
}

/// The last of those records that say the same of the same by the same on the same machine, whatever the commit.
pub(super) fn last_of_each<T>(mut runs: Vec<T>, record: impl Fn(&T) -> &Record) -> Vec<T> {
    let mut seen = std::collections::HashSet::new();
    runs.reverse();
    runs.retain(|run| {
        let Record { subject, by, machine: Machine { processor, threads, adapter, .. }, .. } = record(run);
        seen.insert((subject.clone(), by.clone(), processor.clone(), *threads, adapter.clone()))
    });
    runs.reverse();
    runs
}

/// This project's before other programs'.
pub(super) fn rank(by: &Contender) -> (bool, &Contender) {
    (!by.program.starts_with("tetralux"), by)
}

impl<'a> Points<'a> {
    pub fn new(records: &[&'a Record]) -> Self {
        let mut hosts = Vec::new();
        let mut gathered: BTreeMap<_, Vec<_>> = BTreeMap::new();
        for record in records {
            let Some(measured) = &record.result else { continue };
            let Record { subject, by, machine, .. } = record;
            let host = (machine.processor.as_str(), machine.threads);
            let at = hosts.iter().position(|h| *h == host).unwrap_or_else(|| {
                hosts.push(host);
                hosts.len() - 1
            });
            let group = Group { mesh: &subject.mesh, scene: &subject.scene, size: subject.size, host: at };
            let key = (group, rank(by), machine.adapter.as_str());
            gathered.entry(key).or_default().push((subject, measured));
        }
        let point =
            |((group, (_, by), adapter), views): ((_, (bool, _), _), Vec<_>)| Point::new(group, by, adapter, &views);
        Self { points: gathered.into_iter().filter_map(point).collect(), hosts }
    }

    /// One slice a group.
    pub fn groups(&self) -> impl Iterator<Item = &[Point<'a>]> {
        self.points.chunk_by(|a, b| a.group == b.group)
    }

    /// What tells the host in titles, where there are several.
    pub fn host_note(&self, host: usize) -> String {
        if self.hosts.len() < 2 {
            String::new()
        } else {
            format!(", on {} × {}", self.hosts[host].1, self.hosts[host].0)
        }
    }
}

impl<'a> Point<'a> {
    /// `None` without views.
    fn new(
        group: Group<'a>,
        by: &'a Contender,
        adapter: &'a str,
        views: &[(&'a Subject, &'a Measured)],
    ) -> Option<Self> {
        let times = || views.iter().map(|(_, m)| m.frame_seconds);
        let most = |of: fn(&Deviation) -> f64| views.iter().map(|(_, m)| of(&m.error)).fold(0.0, f64::max);
        let psnr = views.iter().filter_map(|(_, m)| m.error.psnr).reduce(f64::min);
        let mut passes: Vec<(&str, f64)> = Vec::new();
        for pass in views.iter().flat_map(|(_, m)| &m.passes) {
            match passes.iter_mut().find(|(name, _)| *name == pass.name) {
                Some((_, seconds)) => *seconds += pass.seconds,
                None => passes.push((&pass.name, pass.seconds)),
            }
        }
        Some(Self {
            group,
            subject: views.first()?.0,
            by,
            adapter,
            views: views.len(),
            seconds: Spread {
                median: median(times().map(|t| t.median))?,
                min: times().map(|t| t.min).fold(f64::INFINITY, f64::min),
                max: times().map(|t| t.max).fold(0.0, f64::max),
                frames: times().map(|t| t.frames).sum(),
            },
            error: Deviation {
                max: most(|e| e.max),
                rmse: most(|e| e.rmse),
                psnr,
                percentile_99_9: most(|e| e.percentile_99_9),
                above_8_bit: most(|e| e.above_8_bit),
            },
            bytes: views.iter().filter_map(|(_, m)| m.device_bytes.or(m.peak_bytes)).max(),
            passes,
        })
    }
}

/// `None` of nothing.
pub(super) fn median(numbers: impl Iterator<Item = f64>) -> Option<f64> {
    let mut numbers: Vec<f64> = numbers.collect();
    numbers.sort_by(f64::total_cmp);
    let last = numbers.len().checked_sub(1)?;
    Some(0.5 * (numbers[last / 2] + numbers[numbers.len() / 2]))
}
