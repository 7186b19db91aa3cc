//! The unweighted closed forms, on the host and as the shader's text, against quadrature.

use std::f64::consts::{PI, TAU};

use naga_rust_rt::{Vec3, Vec4};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use tetralux::tables::unweighted::{
    SHORT_NODES, Wave, has_table, mean_transmittance_gaussian, mean_transmittance_wave,
};
use tetralux::tables::{Interpolation, Kind};

use crate::reference::{arch_rise, cosine_rise, erf_rise, visible_length};

#[allow(warnings, clippy::all, clippy::allow_attributes_without_reason, reason = "translated by a tool")]
mod translated {
    include!("../kernels/translated.rs");
}

use translated::single as shader;

/// A piece of a ray: its start, extent (periods for waves), strength, and how it should come out.
#[derive(Clone, Copy, Debug)]
pub struct Piece {
    pub start: f32,
    pub extent: f32,
    pub strength: f32,
    pub truth: f64,
}

/// What the piece runs through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Profile {
    Gaussian,
    Wave(Wave),
}

impl Profile {
    /// Depth of the piece's first share.
    fn depth(self, start: f32, extent: f32, strength: f32, share: f64) -> f64 {
        let (start, extent, strength) = (f64::from(start), f64::from(extent), f64::from(strength));
        let rise = |turn: f64, rise: fn(f64, f64) -> f64| {
            let first = turn * (start - start.floor());
            strength * rise(first, first + turn * extent * share)
        };
        match self {
            Self::Gaussian => strength * erf_rise(start, start + extent * share),
            Self::Wave(Wave::Arch) => rise(PI, arch_rise),
            Self::Wave(Wave::Cosine) => rise(TAU, cosine_rise),
        }
    }

    fn truth(self, start: f32, extent: f32, strength: f32) -> f64 {
        let (start, extent, strength) = (f64::from(start), f64::from(extent), f64::from(strength));
        let wave = |turn: f64, rise| {
            let first = turn * (start - start.floor());
            visible_length(strength, first, first + turn * extent, turn / 4.0, rise) / (turn * extent)
        };
        match self {
            Self::Gaussian => {
                // Beyond 6 the tail's depth is 1e-14 at most.
                let (low, high) = (start.max(-6.0), (start + extent).min(6.0));
                if low >= high {
                    return 1.0;
                }
                let clear = (low - start) + (start + extent - high) * (-strength * erf_rise(low, high)).exp();
                (clear + visible_length(strength, low, high, 1.5, erf_rise)) / extent
            }
            Self::Wave(Wave::Arch) => wave(PI, arch_rise),
            Self::Wave(Wave::Cosine) => wave(TAU, cosine_rise),
        }
    }

    /// The host's closed form.
    pub fn mean_transmittance(self, piece: Piece, interpolation: Interpolation) -> Option<f32> {
        let Piece { start, extent, strength, .. } = piece;
        let depth = |share: f32| self.depth(start, extent, strength, f64::from(share)) as f32;
        match self {
            Self::Gaussian => mean_transmittance_gaussian(start, extent, strength, depth, interpolation),
            Self::Wave(wave) => mean_transmittance_wave(wave, start, extent, strength, depth, interpolation),
        }
    }

    /// The same as a shader puts it together.
    fn shader(self, piece: Piece) -> f32 {
        let Piece { start, extent, strength, .. } = piece;
        let depth = |share: f64| self.depth(start, extent, strength, share) as f32;
        let wave = |wave: Wave, rest: fn(f64, f64) -> f64, period: f32| {
            let turn = wave.turn();
            if shader::is_short(turn * extent, depth(1.0)) {
                return short(SHORT_NODES.map(|x| depth(f64::from(x))));
            }
            let span: [f32; 3] = shader::wave_span(start, extent, turn).into();
            let k = [span[0], span[1], 0.0].map(|phase| cubic(wave.kind(), strength, phase / turn));
            let rest = strength * rest(f64::from(span[0]), f64::from(turn)) as f32;
            let (span, k) = (Vec3::from(span), Vec3::from(k));
            shader::mean_transmittance_wave(span, turn * extent, k, rest, strength * period, depth(1.0))
        };
        match self {
            Self::Wave(Wave::Arch) => wave(Wave::Arch, |u, _| 1.0 + u.cos(), 2.0),
            Self::Wave(Wave::Cosine) => wave(Wave::Cosine, |u, _| cosine_rise(u.min(TAU), TAU), std::f32::consts::PI),
            Self::Gaussian if shader::is_short(extent, depth(1.0)) => short(SHORT_NODES.map(|x| depth(f64::from(x)))),
            Self::Gaussian => {
                let span: [f32; 4] = shader::gaussian_span(start, extent).into();
                let [from, to] = [span[2], span[3]].map(|v| cubic(Kind::GaussianJ, strength, (v + 4.0) / 8.0));
                shader::mean_transmittance_gaussian(Vec4::from(span), extent, from, to, depth(1.0))
            }
        }
    }
}

fn short([a, b, c, d, e]: [f32; 5]) -> f32 {
    shader::mean_transmittance_short(a, b, c, d, e)
}

/// A cubic look-up with the shader's positions and weights; `across` is the second argument's position.
fn cubic(kind: Kind, strength: f32, across: f32) -> f32 {
    let table = kind.table();
    let [(i, x), (j, y)] = [shader::strength_position(strength), across.clamp(0.0, 1.0)].map(|position| {
        let at = position * 255.0;
        let start = shader::cubic_start(at, 256.0);
        let weights: [f32; 4] = shader::cubic_weights(at - start).into();
        (start as usize, weights)
    });
    let row = |r: usize| (0..4).map(|c| x[c] * table.values[i + c + table.size[0] * (j + r)]).sum::<f32>();
    (0..4).map(|r| y[r] * row(r)).sum()
}

/// Pieces of strengths from 1e-3 to `most`: for Gaussians all around, long and short; for waves within a period, up to a
/// period's end, and over up to 20 periods.
pub fn sweep(profile: Profile, most: f32, count: usize) -> Vec<Piece> {
    let mut rng = StdRng::seed_from_u64(7);
    let pieces = (0..count).map(|turn| {
        let mut between = |low: f32, high: f32| rng.random_range(low..high);
        let strength = (most.ln() - between(0.0, 1.0) * (most / 1e-3).ln()).exp();
        let (start, extent) = match profile {
            Profile::Gaussian => (between(-5.0, 5.0), 1e-3 * 2e4f32.powf(between(0.0, 1.0))),
            Profile::Wave(_) => {
                let start = between(-3.0, 3.0);
                let extent = match turn % 3 {
                    0 => 1e-3f32.powf(between(0.0, 1.0)),
                    1 => start.ceil() - start,
                    _ => 20.0f32.powf(between(0.0, 1.0)),
                };
                (start, extent)
            }
        };
        let truth = profile.truth(start, extent, strength);
        Piece { start, extent, strength, truth }
    });
    pieces.filter(|p| p.extent > 0.0).collect()
}

/// The largest error over pieces; infinite for NaN and for a piece without a result.
pub fn worst(pieces: &[Piece], mean: impl Fn(Piece) -> Option<f32>) -> (f64, Option<Piece>) {
    let mut worst = (0.0, None);
    for &piece in pieces {
        let error = mean(piece).map_or(f64::INFINITY, |got| (f64::from(got) - piece.truth).abs());
        let error = if error.is_nan() { f64::INFINITY } else { error };
        if error > worst.0 {
            worst = (error, Some(piece));
        }
    }
    worst
}

const PROFILES: [Profile; 3] = [Profile::Gaussian, Profile::Wave(Wave::Arch), Profile::Wave(Wave::Cosine)];

#[test]
fn the_shaders_text_is_the_hosts() {
    let difference = |host: &dyn Fn(Profile, Piece) -> f32| {
        let mut worst = 0.0f32;
        for profile in PROFILES {
            for piece in sweep(profile, 1e3, 3000) {
                let change = (profile.shader(piece) - host(profile, piece)).abs();
                worst = worst.max(if change.is_nan() { f32::INFINITY } else { change });
            }
        }
        worst
    };
    let host = |profile: Profile, piece| {
        profile.mean_transmittance(piece, Interpolation::Cubic).expect("a strength within the table")
    };
    let same = difference(&host);
    println!("shader and host: {same:.1e}");
    assert!(same <= SAME, "{same:e}");
    // Another look-up, or a length of 1 %, would be seen.
    let bilinear =
        |profile: Profile, piece| profile.mean_transmittance(piece, Interpolation::Bilinear).expect("as above");
    assert!(difference(&bilinear) > 10.0 * SAME);
    assert!(
        difference(&|profile, piece: Piece| host(profile, Piece { extent: 1.01 * piece.extent, ..piece }))
            > 10.0 * SAME
    );
}

/// Rounding of two orders of operations, over extents down to 1e-3. Measured: 9.5e-7.
const SAME: f32 = 2e-6;

#[test]
fn the_shaders_positions_are_the_hosts() {
    let mut worst = 0.0f64;
    for i in 0..=4000 {
        let t = 1e-8 * 10f32.powf(0.005 * i as f32);
        for (got, kind) in [(shader::strength_position(t), Kind::GaussianJ), (shader::psi_position(t), Kind::Psi)] {
            worst = worst.max((f64::from(got) - kind.axes()[0].position(f64::from(t))).abs());
        }
    }
    println!("positions: {worst:.1e}");
    // Measured: 9.7e-8 of an axis.
    assert!(worst <= 1.5e-7, "{worst:e}");
}

#[test]
fn short_pieces_need_no_table_and_strong_ones_say_so() {
    for profile in PROFILES {
        let mut piece = Piece { start: 0.3, extent: 1e-6, strength: 2e3, truth: 1.0 };
        piece.truth = profile.truth(piece.start, piece.extent, piece.strength);
        let (error, _) = worst(&[piece], |p| profile.mean_transmittance(p, Interpolation::Cubic));
        println!("short: {error:.1e}");
        // Measured: 1.2e-8.
        assert!(error < 3e-8, "{profile:?} {error:e}");
        piece.extent = 2.0;
        assert_eq!(profile.mean_transmittance(piece, Interpolation::Cubic), None);
        piece.strength = f32::NAN;
        assert_eq!(profile.mean_transmittance(piece, Interpolation::Cubic), None);
    }
    assert!(has_table(0.0) && has_table(999.9) && !has_table(1e3) && !has_table(-1.0));
}

#[test]
fn far_pieces_are_clear_and_finite() {
    for (start, extent) in [(-1e15f32, 2e15f32), (-1e6, 2.0), (1e6, 2.0), (1e15, 1e15), (-1e6, 1e6), (3.9, 1e6)] {
        let piece = Piece { start, extent, strength: 1.0, truth: 0.0 };
        let got = Profile::Gaussian.mean_transmittance(piece, Interpolation::Cubic).expect("a strength in the table");
        let want = Profile::Gaussian.truth(start, extent, 1.0);
        println!("far: {:.1e}", (f64::from(got) - want).abs());
        // Measured: 2.5e-8.
        assert!((f64::from(got) - want).abs() < 1e-7, "{start} {extent}: {got} {want}");
    }
    for periods in [1e3f32, 1e6] {
        for wave in [Wave::Arch, Wave::Cosine] {
            // Many thin periods: as a uniform medium of their depth.
            let piece = Piece { start: 0.3, extent: periods, strength: 1.0 / periods, truth: 0.0 };
            let got = Profile::Wave(wave).mean_transmittance(piece, Interpolation::Cubic).expect("as above");
            let depth = if wave == Wave::Arch { 2.0 } else { PI };
            let want = -(-depth).exp_m1() / depth;
            println!("many: {:.1e}", (f64::from(got) - want).abs());
            // Measured: 1.4e-4 of 1e3 periods, of which the last is cut.
            assert!((f64::from(got) - want).abs() < 3e-4, "{wave:?} {periods}: {got} {want}");
        }
    }
}

#[test]
fn a_planted_error_is_measured() {
    let pieces = sweep(Profile::Gaussian, 50.0, 200);
    let honest = |p| Profile::Gaussian.mean_transmittance(p, Interpolation::Cubic);
    assert!(worst(&pieces, honest).0 < 1e-3);
    assert!(worst(&pieces, |p| honest(p).map(|t| t + 2e-3)).0 > 1e-3);
    assert_eq!(worst(&pieces, |p| honest(p).map(|_| f32::NAN)).0, f64::INFINITY);
    assert_eq!(worst(&pieces, |_| None).0, f64::INFINITY);
}
