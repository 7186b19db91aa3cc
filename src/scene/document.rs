//! A scene's TOML text with the command line's assignments laid over it. It promises that whatever is wrong with a value
//! can be told with its key and with the line or flag that it came from.

use std::borrow::Cow;
use std::ops::Range;
use std::path::Path;

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue, Deserializer};

use crate::error::{Error, Result};

/// A value for one scene key that replaces, or adds to, what the scene file says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Override {
    /// Dotted; a number counts list items from 0: `transfer.widget.0.extinction`. One past the last item appends.
    pub key: String,
    /// A TOML value. What does not parse as one is taken as a string, so that names need no quotes.
    pub value: String,
    /// How messages call it: the flag as typed.
    pub origin: String,
}

/// Keys of which only one side makes sense: overriding one drops the other side from the file.
const ALTERNATIVES: [(&[&str], &[&str]); 8] = [
    (&["camera.eye", "camera.target", "camera.up"], &["camera.azimuth", "camera.elevation", "camera.zoom"]),
    (&["camera.azimuth", "camera.elevation", "camera.zoom"], &["camera.eye", "camera.target", "camera.up"]),
    (&["camera.fov_y"], &["camera.height", "camera.projection"]),
    (&["camera.height"], &["camera.fov_y", "camera.projection"]),
    (&["camera.projection"], &["camera.fov_y", "camera.height"]),
    (&["transfer.curve"], &["transfer.widget", "transfer.draw"]),
    (&["transfer.widget"], &["transfer.curve", "transfer.draw"]),
    (&["units", "transfer.units"], &["units", "transfer.units"]),
];

/// What is wrong with a key.
#[derive(Debug)]
pub(super) struct Problem {
    /// Dotted, as in [`Override::key`].
    pub key: String,
    /// What is wrong, and what to do.
    pub why: String,
}

impl Problem {
    pub(super) fn new(key: impl Into<String>, why: impl Into<String>) -> Self {
        Self { key: key.into(), why: why.into() }
    }
}

/// The merged tree; every node remembers where it came from.
pub(super) struct Document<'a> {
    text: &'a str,
    overrides: &'a [Override],
    path: Option<&'a Path>,
    root: Spanned<DeTable<'a>>,
}

impl<'a> Document<'a> {
    /// Parses `text` and applies `overrides` in order. `path` is only named in messages.
    pub(super) fn parse(text: &'a str, overrides: &'a [Override], path: Option<&'a Path>) -> Result<Self> {
        let empty = Spanned::new(0..0, DeTable::new());
        let mut document = Self { text, overrides, path, root: empty };
        document.root = DeTable::parse(text).map_err(|e| document.explain(&e))?;
        for choice in overrides {
            document.drop_alternatives(&choice.key);
        }
        for (index, choice) in overrides.iter().enumerate() {
            document.apply(index, choice)?;
        }
        Ok(document)
    }

    /// The tree as a `T`.
    pub(super) fn read<T: DeserializeOwned>(&self) -> Result<T> {
        T::deserialize(Deserializer::from(self.root.clone())).map_err(|e| self.explain(&e))
    }

    /// The error for a value that parses and makes no sense.
    pub(super) fn refuse(&self, problem: &Problem) -> Error {
        let span = self.span_of(&problem.key);
        let flag = self.flag_at(&span);
        let place = match (flag, self.text.is_empty()) {
            (Some(flag), _) => format!("{}: ", flag.origin),
            (None, true) => String::new(),
            (None, false) => format!("scene line {}, ", self.line(span.start)),
        };
        self.error(format!("{place}{}: {}", problem.key, problem.why), flag.is_some())
    }

    fn explain(&self, error: &toml::de::Error) -> Error {
        let message = error.message().trim().replace('\n', "; ");
        let message =
            message.replace("expected i64", "expected a whole number").replace("expected f64", "expected a number");
        let Some(span) = error.span() else { return self.error(format!("scene: {message}"), false) };
        if let Some(flag) = self.flag_at(&span) {
            return self.error(format!("{}: {}: {message}", flag.origin, flag.key), true);
        }
        let mut best = (usize::MAX, String::new());
        for (key, value) in self.root.get_ref() {
            find_key(key.get_ref(), &key.span(), value, &span, &mut best);
        }
        let key = if best.1.is_empty() { String::new() } else { format!(", {}", best.1) };
        self.error(format!("scene line {}{key}: {message}", self.line(span.start)), false)
    }

    fn error(&self, what: String, from_flag: bool) -> Error {
        Error::Asked(match self.path {
            Some(path) if !from_flag => format!("{what}: {}", path.display()),
            _ => what,
        })
    }

    fn line(&self, byte: usize) -> usize {
        1 + self.text.bytes().take(byte).filter(|b| *b == b'\n').count()
    }

    /// Overrides' nodes are marked by spans beyond the text.
    fn mark(&self, index: usize) -> Range<usize> {
        let start = self.text.len() + 1 + index;
        start..start + 1
    }

    fn flag_at(&self, span: &Range<usize>) -> Option<&'a Override> {
        self.overrides.get(span.start.checked_sub(self.text.len() + 1)?)
    }

    /// Where `key` stands, or its nearest parent that does.
    fn span_of(&self, key: &str) -> Range<usize> {
        let mut parts = key.split('.');
        let Some(mut node) = parts.next().and_then(|part| self.root.get_ref().get(part)) else { return 0..0 };
        for part in parts {
            let child = match node.get_ref() {
                DeValue::Table(table) => table.get(part),
                DeValue::Array(array) => part.parse::<usize>().ok().and_then(|i| array.get(i)),
                _ => None,
            };
            match child {
                Some(child) => node = child,
                None => break,
            }
        }
        node.span()
    }

    fn drop_alternatives(&mut self, key: &str) {
        let concerns = |k: &&str| key == *k || key.strip_prefix(*k).is_some_and(|rest| rest.starts_with('.'));
        for dropped in ALTERNATIVES.iter().filter(|(set, _)| set.iter().any(concerns)).flat_map(|(_, other)| *other) {
            match dropped.split_once('.') {
                None => drop(self.root.get_mut().remove(*dropped)),
                Some((table, name)) => {
                    if let Some(DeValue::Table(table)) = self.root.get_mut().get_mut(table).map(Spanned::get_mut) {
                        table.remove(name);
                    }
                }
            }
        }
    }

    fn apply(&mut self, index: usize, choice: &'a Override) -> Result<()> {
        let mark = self.mark(index);
        let value = match DeValue::parse(&choice.value) {
            Ok(value) => value.into_inner(),
            Err(_) => DeValue::String(Cow::Borrowed(choice.value.as_str())),
        };
        let parts: Vec<&str> = choice.key.split('.').collect();
        let mut root = Spanned::new(mark.clone(), DeValue::Table(std::mem::take(self.root.get_mut())));
        let done = assign(&mut root, &parts, remark(value, &mark), &mark);
        if let DeValue::Table(table) = root.into_inner() {
            *self.root.get_mut() = table;
        }
        done.map_err(|why| Error::Asked(format!("{}: {}: {why}", choice.origin, choice.key)))
    }
}

/// Puts `value` at `parts` below `node`, making the tables and lists on the way.
fn assign<'a>(
    node: &mut Spanned<DeValue<'a>>,
    parts: &[&str],
    value: Spanned<DeValue<'a>>,
    mark: &Range<usize>,
) -> Result<(), String> {
    let [first, rest @ ..] = parts else {
        *node = value;
        return Ok(());
    };
    let fresh = || {
        let list = rest.first().is_some_and(|part| part.parse::<usize>().is_ok());
        Spanned::new(mark.clone(), if list { DeValue::Array(DeArray::new()) } else { DeValue::Table(DeTable::new()) })
    };
    match node.get_mut() {
        DeValue::Table(table) => {
            let key = Spanned::new(mark.clone(), Cow::Owned((*first).to_owned()));
            assign(table.entry(key).or_insert_with(fresh), rest, value, mark)
        }
        DeValue::Array(array) => {
            let count = array.len();
            let index = first.parse::<usize>().ok();
            if index == Some(count) {
                array.push(fresh());
            }
            match index.and_then(|index| array.get_mut(index)) {
                Some(item) => assign(item, rest, value, mark),
                None => Err(format!("'{first}' is no item of a list of {count}: items count from 0")),
            }
        }
        _ => Err(format!("'{first}' is below a plain value")),
    }
}

/// `value` with every span replaced by `mark`.
fn remark<'a>(value: DeValue<'a>, mark: &Range<usize>) -> Spanned<DeValue<'a>> {
    let value = match value {
        DeValue::Array(items) => {
            DeValue::Array(items.into_iter().map(|item| remark(item.into_inner(), mark)).collect())
        }
        DeValue::Table(table) => DeValue::Table(
            table
                .into_iter()
                .map(|(key, item)| (Spanned::new(mark.clone(), key.into_inner()), remark(item.into_inner(), mark)))
                .collect(),
        ),
        plain => plain,
    };
    Spanned::new(mark.clone(), value)
}

/// The path of the smallest node whose key or value holds `span`.
fn find_key(
    path: &str,
    key: &Range<usize>,
    node: &Spanned<DeValue<'_>>,
    span: &Range<usize>,
    best: &mut (usize, String),
) {
    for own in [key, &node.span()] {
        if own.start <= span.start && span.end <= own.end && own.len() <= best.0 {
            *best = (own.len(), path.to_owned());
        }
    }
    match node.get_ref() {
        DeValue::Table(table) => {
            for (name, child) in table {
                find_key(&format!("{path}.{}", name.get_ref()), &name.span(), child, span, best);
            }
        }
        DeValue::Array(array) => {
            for (index, child) in array.iter().enumerate() {
                find_key(&format!("{path}.{index}"), &child.span(), child, span, best);
            }
        }
        _ => {}
    }
}
