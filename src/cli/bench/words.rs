//! Numbers and names as people read them.

use crate::report::record::{Contender, Subject};

/// Three digits, without an exponent where that is short.
pub(super) fn short(value: f64) -> String {
    let magnitude = value.abs();
    match magnitude {
        0.0 => "0".into(),
        1e-3..1e5 => {
            let decimals = (2.0 - magnitude.log10().floor()).clamp(0.0, 5.0) as usize;
            format!("{value:.decimals$}")
        }
        _ => format!("{value:.2e}"),
    }
}

/// Seconds as milliseconds.
pub(super) fn milliseconds(seconds: f64) -> String {
    short(1e3 * seconds)
}

/// `None` where a picture equals the reference.
pub(super) fn decibels(psnr: Option<f64>) -> String {
    psnr.map_or("equal".into(), |p| format!("{p:.1}"))
}

/// `1.5 MiB`.
pub(super) fn bytes(count: u64) -> String {
    let units = ["B", "KiB", "MiB", "GiB", "TiB"];
    let (mut value, mut unit) = (count as f64, 0);
    while value >= 1024.0 && unit + 1 < units.len() {
        (value, unit) = (value / 1024.0, unit + 1);
    }
    format!("{} {}", short(value), units[unit])
}

/// `62 772`, with narrow spaces.
pub(super) fn grouped(count: u64) -> String {
    let digits = count.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

/// What has a colour of its own.
pub(super) fn method(by: &Contender) -> String {
    format!("{} {} {}", by.program, by.device, by.method)
}

/// What has a shape of its own: an integral without its number.
pub(super) fn integral(by: &Contender) -> &str {
    by.integral.split(':').next().unwrap_or_default()
}

/// `640×480`.
pub(super) fn size(subject: &Subject) -> String {
    let [width, height] = subject.size;
    format!("{width}×{height}")
}

/// Fit for a file's name: what is not a letter, digit, `.`, `_` or `-` becomes `_`.
pub(super) fn file_name(text: &str) -> String {
    text.chars().map(|c| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '_' }).collect()
}

/// Fit for HTML and XML, within and outside quotes. Characters that XML cannot hold become question marks.
pub(super) fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            c => escaped.push(printable(c)),
        }
    }
    escaped
}

/// XML has no control characters but line ends and tabs, and not the two last of the first plane.
pub(super) fn printable(c: char) -> char {
    match c {
        '\n' | '\t' => c,
        '\u{fffe}' | '\u{ffff}' => '?',
        c if c.is_control() => '?',
        c => c,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (value, text) in [
            (0.0, "0"),
            (12.345, "12.3"),
            (0.012_345, "0.0123"),
            (1234.5, "1234"),
            (1.0, "1.00"),
            (1.234e-7, "1.23e-7"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(short(value), text);
        }
        assert_eq!((bytes(512), bytes(3 << 20)), ("512 B".into(), "3.00 MiB".into()));
        assert_eq!(grouped(1_062_772).replace('\u{202f}', " "), "1 062 772");
        assert_eq!(grouped(62), "62");
    }

    #[test]
    fn text_is_escaped() {
        assert_eq!(escape("<a href='x'>\"&\u{1}"), "&lt;a href=&#39;x&#39;&gt;&quot;&amp;?");
        assert_eq!(file_name("adaptive:1e-3/a b"), "adaptive_1e-3_a_b");
    }
}
