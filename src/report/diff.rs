//! Two lists of runs of the same plan: what became worse. Errors of pictures do not vary from run to run, so that any
//! growth counts; times do, so that only what lies beyond both spreads counts.

use std::collections::{HashMap, HashSet};
use std::fmt;

use serde::Serialize;

use super::record::{Contender, Deviation, Machine, Measured, Record, Subject};

/// Errors may grow by rounding alone: this share, and this much.
const RELATIVE: f64 = 1e-6;
const ABSOLUTE: f64 = 1e-9;

/// What became of the runs of an old list in a new one.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Differences {
    /// Pairs whose errors were compared.
    pub compared: usize,
    /// Of these, how many ran on another machine or adapter, so that their times were not compared.
    pub elsewhere: usize,
    /// Errors that grew.
    pub errors_grew: Vec<Change>,
    /// Errors that shrank.
    pub errors_shrank: Vec<Change>,
    /// Median times that grew beyond both spreads.
    pub times_grew: Vec<Change>,
    /// Median times that shrank beyond both spreads.
    pub times_shrank: Vec<Change>,
    /// Drawn before, refused now, and why.
    pub refused: Vec<(Run, String)>,
    /// Drawn before, not in the new list.
    pub missing: Vec<Run>,
    /// What they draw is not the same any more: pictures of different hashes cannot be compared.
    pub other_subject: Vec<Run>,
    /// Refused or not there before, drawn now.
    pub added: usize,
}

/// What was drawn, and by what: how runs of two lists are paired.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub struct Run {
    /// Its hash is that of the old list.
    pub subject: Subject,
    /// See the type.
    pub by: Contender,
}

/// A number that changed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Change {
    /// Of which run.
    pub run: Run,
    /// As a record names it; of times, `frame_seconds`.
    pub what: &'static str,
    /// In the old list.
    pub old: f64,
    /// In the new list.
    pub new: f64,
}

impl Differences {
    /// Compares two lists. Of runs that were repeated within a list, the last counts.
    pub fn new(old: &[Record], new: &[Record]) -> Self {
        let mut found = Self::default();
        let pairs = Pairs::new(new);
        let mut seen = HashSet::new();
        for (i, before) in old.iter().enumerate() {
            if old[i + 1..].iter().any(|later| key(later) == key(before) && same_place(later, before)) {
                continue;
            }
            let after = pairs.of(before);
            seen.extend(after.filter(|_| before.result.is_some()).map(key));
            found.pair(before, after);
        }
        found.added = pairs.drawn().filter(|record| !seen.contains(&key(record))).count();
        found
    }

    /// True where a number grew, or a run is not there any more.
    pub fn is_worse(&self) -> bool {
        let grew = !self.errors_grew.is_empty() || !self.times_grew.is_empty();
        grew || !self.refused.is_empty() || !self.missing.is_empty()
    }

    fn pair(&mut self, old: &Record, new: Option<&Record>) {
        let Some(before) = &old.result else { return };
        let run = Run { subject: old.subject.clone(), by: old.by.clone() };
        let Some(new) = new else { return self.missing.push(run) };
        if new.subject.hash != old.subject.hash {
            return self.other_subject.push(run);
        }
        let Some(after) = &new.result else {
            return self.refused.push((run, new.refused.clone().unwrap_or_default()));
        };
        self.compared += 1;
        self.errors(&run, &before.error, &after.error);
        if same_machine(&old.machine, &new.machine) {
            self.times(run, before, after);
        } else {
            self.elsewhere += 1;
        }
    }

    fn errors(&mut self, run: &Run, old: &Deviation, new: &Deviation) {
        for (what, old, new) in [
            ("max", old.max, new.max),
            ("rmse", old.rmse, new.rmse),
            ("percentile_99_9", old.percentile_99_9, new.percentile_99_9),
            ("above_8_bit", old.above_8_bit, new.above_8_bit),
        ] {
            let change = || Change { run: run.clone(), what, old, new };
            // What is no number counts as grown.
            if new > old * (1.0 + RELATIVE) + ABSOLUTE || new.is_nan() {
                self.errors_grew.push(change());
            } else if new < old * (1.0 - RELATIVE) - ABSOLUTE {
                self.errors_shrank.push(change());
            }
        }
    }

    fn times(&mut self, run: Run, old: &Measured, new: &Measured) {
        let [old, new] = [old.frame_seconds, new.frame_seconds];
        let change = Change { run, what: "frame_seconds", old: old.median, new: new.median };
        if new.median > old.max && old.median < new.min {
            self.times_grew.push(change);
        } else if new.median < old.min && old.median > new.max {
            self.times_shrank.push(change);
        }
    }
}

/// What a run is paired by: everything but the hash.
type Key<'a> = (&'a str, &'a str, &'a str, [u32; 2], &'a Contender);

fn key(record: &Record) -> Key<'_> {
    let Subject { mesh, scene, view, size, .. } = &record.subject;
    (mesh, scene, view, *size, &record.by)
}

fn same_place(a: &Record, b: &Record) -> bool {
    same_machine(&a.machine, &b.machine)
}

/// Times can be compared: the commit is meant to differ, and a system is kept up to date.
fn same_machine(a: &Machine, b: &Machine) -> bool {
    (&a.processor, a.threads, &a.adapter) == (&b.processor, b.threads, &b.adapter)
}

/// The new list, by key.
struct Pairs<'a>(HashMap<Key<'a>, Vec<&'a Record>>);

impl<'a> Pairs<'a> {
    fn new(records: &'a [Record]) -> Self {
        let mut by_key: HashMap<_, Vec<_>> = HashMap::new();
        for record in records {
            by_key.entry(key(record)).or_default().push(record);
        }
        Self(by_key)
    }

    /// Of the same machine where there is one.
    fn of(&self, old: &Record) -> Option<&'a Record> {
        let candidates = self.0.get(&key(old))?;
        let here = candidates.iter().rev().find(|new| same_place(old, new));
        here.or(candidates.last()).copied()
    }

    /// One of each key that was drawn.
    fn drawn(&self) -> impl Iterator<Item = &'a Record> {
        self.0.values().filter_map(|records| records.iter().rev().find(|r| r.result.is_some()).copied())
    }
}

impl fmt::Display for Run {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Subject { mesh, scene, view, size: [width, height], .. } = &self.subject;
        let Contender { program, device, method, integral, order } = &self.by;
        write!(f, "{mesh} {scene} {view} {width}x{height}: {program} {device} {method} {integral} {order}")
    }
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { run, what, old, new } = self;
        write!(f, "{run}: {what} {old:.4e} -> {new:.4e}")?;
        // From nothing there is no share.
        if *old > 0.0 { write!(f, " ({:+.2} %)", 100.0 * (new / old - 1.0)) } else { Ok(()) }
    }
}

impl fmt::Display for Differences {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "compared        {} runs", self.compared)?;
        if self.elsewhere > 0 {
            writeln!(f, "times           of {} not compared: another machine or adapter", self.elsewhere)?;
        }
        if self.added > 0 {
            writeln!(f, "new             {} runs", self.added)?;
        }
        list(f, "errors grew", &self.errors_grew)?;
        list(f, "times grew", &self.times_grew)?;
        let refused: Vec<String> = self.refused.iter().map(|(run, why)| format!("{run}: {why}")).collect();
        list(f, "now refused", &refused)?;
        list(f, "missing", &self.missing)?;
        list(f, "not comparable, as the subject's hash changed", &self.other_subject)?;
        list(f, "errors shrank", &self.errors_shrank)?;
        list(f, "times shrank", &self.times_shrank)?;
        f.write_str(match (self.is_worse(), self.compared) {
            (true, _) => "verdict         worse",
            (false, 0) => "verdict         none: nothing could be compared",
            (false, _) => "verdict         nothing became worse",
        })
    }
}

fn list<T: fmt::Display>(f: &mut fmt::Formatter<'_>, title: &str, items: &[T]) -> fmt::Result {
    if items.is_empty() {
        return Ok(());
    }
    writeln!(f, "{title}: {}", items.len())?;
    items.iter().try_for_each(|item| writeln!(f, "  {item}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::record::Spread;

    fn record(mesh: &str) -> Record {
        let subject = Subject {
            mesh: mesh.into(),
            scene: "bands".into(),
            view: "front".into(),
            size: [64, 48],
            tetrahedra: 1_000,
            hash: "00ff".into(),
        };
        let [device, method, integral, order] = ["gpu", "project", "adaptive:0.001", "power"].map(String::from);
        let by = Contender { program: "tetralux".into(), device, method, integral, order };
        let machine = Machine {
            processor: "a processor".into(),
            threads: 2,
            memory_bytes: 1 << 30,
            system: "Linux".into(),
            adapter: "an adapter".into(),
            commit: "abc".into(),
        };
        let measured = Measured {
            frame_seconds: Spread { median: 0.010, min: 0.009, max: 0.012, frames: 5 },
            cpu_seconds: None,
            passes: Vec::new(),
            drawn: None,
            prepare_seconds: None,
            device_bytes: None,
            peak_bytes: None,
            chosen: None,
            error: Deviation { max: 0.1, rmse: 0.01, psnr: Some(40.0), percentile_99_9: 0.05, above_8_bit: 0.0 },
        };
        Record { subject, by, machine, result: Some(measured), refused: None }
    }

    fn changed(change: impl Fn(&mut Record, &mut Measured)) -> Differences {
        let old = record("fire");
        let mut new = old.clone();
        let mut measured = new.result.take().expect("drawn");
        new.machine.commit = "def".into();
        change(&mut new, &mut measured);
        if new.refused.is_none() {
            new.result = Some(measured);
        }
        Differences::new(&[old, record("other")], &[record("other"), new])
    }

    fn whats(changes: &[Change]) -> Vec<&str> {
        changes.iter().map(|c| c.what).collect()
    }

    #[test]
    fn growth_of_an_error_is_found() {
        let same = changed(|_, m| m.error.max *= 1.0 + 1e-7);
        assert!(!same.is_worse() && same.compared == 2, "{same}");
        let grown = changed(|_, m| m.error.rmse *= 1.01);
        assert_eq!(whats(&grown.errors_grew), ["rmse"]);
        assert!(grown.is_worse() && grown.to_string().contains("(+1.00 %)"), "{grown}");
        let grown = changed(|_, m| (m.error.max, m.error.percentile_99_9, m.error.above_8_bit) = (0.2, 0.06, 1e-6));
        assert_eq!(whats(&grown.errors_grew), ["max", "percentile_99_9", "above_8_bit"]);
        assert!(changed(|_, m| m.error.max = f64::NAN).is_worse());
        let shrunk = changed(|_, m| m.error.rmse *= 0.9);
        assert_eq!((shrunk.is_worse(), whats(&shrunk.errors_shrank)), (false, vec!["rmse"]));
    }

    #[test]
    fn only_times_beyond_both_spreads_count() {
        let time = |median: f64, min: f64, max: f64| {
            changed(move |_, m| m.frame_seconds = Spread { median, min, max, frames: 5 })
        };
        assert!(!time(0.0119, 0.011, 0.015).is_worse(), "within the old spread");
        assert!(!time(0.013, 0.0099, 0.015).is_worse(), "the old one lies within the new spread");
        let slower = time(0.0125, 0.0121, 0.015);
        assert_eq!((slower.is_worse(), whats(&slower.times_grew)), (true, vec!["frame_seconds"]));
        let faster = time(0.005, 0.004, 0.006);
        assert_eq!((faster.is_worse(), faster.times_shrank.len()), (false, 1));
    }

    #[test]
    fn times_of_other_machines_are_not_compared_but_errors_are() {
        let other = |rmse: f64| {
            changed(move |r, m| {
                r.machine.adapter = "another".into();
                m.frame_seconds = Spread { median: 1.0, min: 1.0, max: 1.0, frames: 5 };
                m.error.rmse = rmse;
            })
        };
        let same = other(0.01);
        assert!(!same.is_worse() && same.elsewhere == 1 && same.to_string().contains("another machine"), "{same}");
        assert!(other(0.0101).is_worse());
        // Where a list has runs of several machines, those of the same one are paired.
        let mut slow = record("fire");
        slow.machine.adapter = "another".into();
        let time = &mut slow.result.as_mut().expect("drawn").frame_seconds;
        *time = Spread { median: 1.0, min: 1.0, max: 1.0, frames: 5 };
        let both = [record("fire"), slow];
        let found = Differences::new(&both, &both);
        assert_eq!((found.compared, found.elsewhere, found.is_worse(), found.added), (2, 0, false, 0));
    }

    #[test]
    fn what_is_not_there_any_more_is_worse() {
        let missing = Differences::new(&[record("fire"), record("other")], &[record("fire"), record("third")]);
        assert_eq!((missing.missing.len(), missing.added, missing.is_worse()), (1, 1, true));
        let refused = changed(|r, _| r.refused = Some("no room".into()));
        assert!(refused.is_worse() && refused.to_string().contains("no room"), "{refused}");
        let (mut old, new) = (record("fire"), record("fire"));
        (old.result, old.refused) = (None, Some("no room".into()));
        let drawn = Differences::new(&[old], &[new]);
        assert_eq!((drawn.is_worse(), drawn.added, drawn.compared), (false, 1, 0));
    }

    #[test]
    fn another_subject_is_not_compared() {
        let other = changed(|r, m| {
            r.subject.hash = "beef".into();
            m.error.rmse = 1.0;
        });
        assert_eq!((other.compared, other.other_subject.len(), other.is_worse()), (1, 1, false));
        assert!(other.to_string().contains("not comparable"), "{other}");
        assert_eq!(other.added, 0);
    }

    #[test]
    fn the_last_of_repeated_runs_counts() {
        let mut worse = record("fire");
        worse.result.as_mut().expect("drawn").error.rmse = 1.0;
        assert!(Differences::new(&[record("fire")], &[record("fire"), worse.clone()]).is_worse());
        assert!(!Differences::new(&[record("fire")], &[worse.clone(), record("fire")]).is_worse());
        let old = Differences::new(&[record("fire"), worse], &[record("fire")]);
        assert_eq!((old.compared, old.is_worse(), old.errors_shrank.len()), (1, false, 1));
    }
}
