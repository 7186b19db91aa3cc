#import math/turns

// Means of periodic profiles, times a linear weight, over an interval of phases (in periods; any number of them). Phases
// are taken from the nearest zero, where the profile's relative accuracy is decided; lengths are differences of what was
// rounded. `weights` are those at phases.x and phases.y; the phases may ascend or descend.

// Of (1 - cos 2 pi p) / 2.
fn cosine_mean(phases: real2, weights: real2) -> real {
    let width = phases.y - phases.x;
    let base = floor(0.5 * (phases.x + phases.y) + 0.5);
    let middle = 0.5 * ((phases.x - base) + (phases.y - base));
    let swing = cosine_of_turns(middle);
    let complement = sinc_complement(width);
    let sine = sine_of_turns(0.5 * middle);
    // Two forms of (1 - cos(2 pi middle) sinc(pi width)) / 2: sums of positive terms.
    let mean = select(0.5 * (1.0 - swing * (1.0 - complement)), sine * sine + 0.5 * swing * complement, swing > 0.0);
    let tilt = weights.y - weights.x;
    var product = 0.5 * (weights.x + weights.y) * mean;
    if tilt != 0.0 {
        product += 0.25 * tilt * sine_of_turns(middle) * bessel_one(width);
    }
    return product;
}

// Of sin(pi t), t the distance from a zero, over [near, far] within [0, 1].
fn arch_part(near: real, far: real, near_weight: real, far_weight: real) -> real {
    let middle = 0.5 * (near + far);
    let half_width = 0.5 * (far - near);
    let tilt = far_weight - near_weight;
    var product = 0.5 * (near_weight + far_weight) * sine_of_turns(0.5 * middle) * (1.0 - sinc_complement(half_width));
    if tilt != 0.0 {
        product += 0.5 * tilt * cosine_of_turns(0.5 * middle) * bessel_one(half_width);
    }
    return product;
}

// Of |sin pi p|; `alternate`: only of the arches that begin at an even phase, 0 on the others.
fn arch_mean(phases: real2, weights: real2, alternate: bool) -> real {
    let rising = phases.y >= phases.x;
    let low = min(phases.x, phases.y);
    let high = max(phases.x, phases.y);
    let w_low = select(weights.y, weights.x, rising);
    let w_high = select(weights.x, weights.y, rising);
    let first = ceil(low);
    let last = floor(high);
    // 1 where the arch that begins at `first` counts and the one before it does not.
    let first_is_odd = first - 2.0 * floor(0.5 * first) > 0.5;
    if first > last {
        if alternate && !first_is_odd {
            return 0.0;
        }
        let from_last = low - last;
        let to_first = first - high;
        if from_last <= to_first {
            return arch_part(from_last, high - last, w_low, w_high);
        }
        return arch_part(to_first, first - low, w_high, w_low);
    }
    let left = first - low;
    let right = high - last;
    let width = max(high - low, 1e-30);
    let tilt = w_high - w_low;
    var sum = real(0.0);
    if !alternate || first_is_odd {
        sum += left * arch_part(0.0, left, w_low + tilt * (left / width), w_low);
    }
    let last_is_odd = last - 2.0 * floor(0.5 * last) > 0.5;
    if !alternate || !last_is_odd {
        sum += right * arch_part(0.0, right, w_high - tilt * (right / width), w_high);
    }
    // Whole arches, by the weight at the middle of their centres.
    var count = last - first;
    var center = 0.5 * (first + last);
    if alternate {
        let start = select(first, first + 1.0, first_is_odd);
        count = ceil(0.5 * (last - start));
        center = start + count - 0.5;
    }
    sum += 0.6366197723675814 * count * (w_low + tilt * ((center - low) / width));
    return sum / width;
}

// The integral of max(0, 1 - (1 - 2 t) / duty), t the distance from a valley, over [near, far] within [0, 1/2].
fn triangle_slope(near: real, far: real, near_weight: real, far_weight: real, duty: real) -> real {
    // Distance from where the slope begins: exact in f32 on either side.
    let foot = 0.5 * (1.0 - duty);
    let half_duty = 0.5 * duty;
    let e_near = select(near - foot, half_duty - (0.5 - near), near > 0.25);
    let e_far = select(far - foot, half_duty - (0.5 - far), far > 0.25);
    let width = far - near;
    if !(e_far > 0.0 && width > 0.0) {
        return 0.0;
    }
    let below = e_near < 0.0;
    let start = max(e_near, 0.0);
    let part = select(width, min(e_far, width), below);
    let w_start = select(near_weight, far_weight - (far_weight - near_weight) * (part / width), below);
    let sum = (w_start * start + far_weight * e_far) / 3.0 + (w_start * e_far + far_weight * start) / 6.0;
    return part * sum / half_duty;
}

// The integral over [low, high] within the period that begins at `valley`.
fn triangle_period(low: real, high: real, w_low: real, w_high: real, valley: real, duty: real) -> real {
    let next = valley + 1.0;
    let width = max(high - low, 1e-30);
    let tilt = w_high - w_low;
    // Up to the peak and from it.
    let up_near = min(low - valley, 0.5);
    let up_far = min(high - valley, 0.5);
    let down_near = min(next - high, 0.5);
    let down_far = min(next - low, 0.5);
    let to_peak = min((up_far - up_near) / width, 1.0);
    let from_peak = min((down_far - down_near) / width, 1.0);
    return triangle_slope(up_near, up_far, w_low, w_low + tilt * to_peak, duty)
        + triangle_slope(down_near, down_far, w_high, w_high - tilt * from_peak, duty);
}

// Of max(0, 1 - |2 frac p - 1| / duty), duty in (0, 1].
fn triangle_mean(phases: real2, weights: real2, duty: real) -> real {
    let rising = phases.y >= phases.x;
    let low = min(phases.x, phases.y);
    let high = max(phases.x, phases.y);
    let w_low = select(weights.y, weights.x, rising);
    let w_high = select(weights.x, weights.y, rising);
    let width = high - low;
    if !(width > 1e-30) {
        return 0.5 * (w_low + w_high) * triangle_at(low, duty);
    }
    let first = ceil(low);
    let last = floor(high);
    if first > last {
        return triangle_period(low, high, w_low, w_high, last, duty) / width;
    }
    let tilt = w_high - w_low;
    let w_first = w_low + tilt * ((first - low) / width);
    let w_last = w_high - tilt * ((high - last) / width);
    let whole = 0.25 * duty * (last - first) * (w_first + w_last);
    return (triangle_period(low, first, w_low, w_first, first - 1.0, duty) + whole
        + triangle_period(last, high, w_last, w_high, last, duty)) / width;
}

// max(0, 1 - |2 frac p - 1| / duty).
fn triangle_at(phase: real, duty: real) -> real {
    let t = abs(phase - floor(phase + 0.5));
    let e = select(t - 0.5 * (1.0 - duty), 0.5 * duty - (0.5 - t), t > 0.25);
    return max(e, 0.0) / (0.5 * duty);
}

// (1 - cos 2 pi p) / 2.
fn cosine_at(phase: real) -> real {
    let sine = sine_of_turns(0.5 * (phase - floor(phase + 0.5)));
    return sine * sine;
}

// |sin pi p|; `alternate` as in arch_mean.
fn arch_at(phase: real, alternate: bool) -> real {
    let index = floor(phase);
    if alternate && index - 2.0 * floor(0.5 * index) > 0.5 {
        return 0.0;
    }
    return abs(sine_of_turns(0.5 * (phase - floor(phase + 0.5))));
}
