//! Shared parts of the ambient occlusion studies: the two presets at a number of samples, with their radii and falloff.

use crate::{Field, Setup};

/// The radii of the two presets, in units of their scenes.
pub(super) const TABLE_RADIUS: f64 = 0.8;
pub(super) const ROOM_RADIUS: f64 = 0.6;

/// The first and the last line that [`HIGHEST_HORIZON`] replaces.
const SECTORS: [&str; 2] = ["        uint mask = 0u;", "        hidden += share * s.all * part / 32.0;"];

/// Ground-truth ambient occlusion as published by J. Jimenez, X. Wu, A. Pesce and A. Jarabo in 2016, and by Intel as
/// XeGTAO in 2021: everything below the highest horizon of a side is hidden. A horizon sinks to the surface's plane as
/// its cause gets farther away.
const HIGHEST_HORIZON: &str = "
        float open = 0.0;
        for (int side = -1; side <= 1; side += 2) {
            float plane = cos(s.normal + float(side) * HALF_PI), horizon = plane;
            for (int j = 0; j < steps; j++) {
                float t = (float(j) + (float(step_) + 0.5) / 4.0) / float(steps);
                ivec2 q = ivec2(floor(pixel + float(side) * along * max(t * t * pixels, float(j) + 1.0)));
                if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, size))) break;
                vec3 delta = viewFromPixel(vec2(q) + 0.5, texelFetch(iChannel0, q, 0).z, canvas) - at;
                float away = length(delta);
                if (dot(delta, normal) < BIAS * away) continue;
                float near = clamp((radius - away) / (0.4 * radius), 0.0, 1.0);
                horizon = max(horizon, mix(plane, dot(delta, view) / away, near));
            }
            open += weightTo(float(side) * acos(clamp(horizon, -1.0, 1.0)), s.normal);
        }
        hidden += share * (s.all - open);";

/// Returns the slices and steps on either side of one, for a number of samples.
pub(super) fn slices(samples: f64) -> (f64, f64) {
    match samples as u32 {
        8 => (1.0, 4.0),
        16 => (2.0, 4.0),
        24 => (2.0, 6.0),
        32 => (2.0, 8.0),
        _ => (4.0, 8.0),
    }
}

/// Returns whether a method is drawn in the scene of `gbuffer-ssao-ssr`; the others are in that of `ssao`.
pub(super) fn is_sliced(method: &str) -> bool {
    matches!(method, "horizons" | "gtao")
}

/// Returns the project of a method with a number of samples, every pass drawn in every frame.
pub(super) fn setup(method: &str, samples: f64, size: (u32, u32)) -> Setup {
    let ssao = |method| {
        let setup = Setup::new("ssao", size).wants(&["geometry", "blur"]).restless();
        setup.uniform("power", 1.0).uniform("method", method).uniform("samples", samples)
    };
    let slices = || {
        let (slices, steps) = slices(samples);
        let setup = Setup::new("gbuffer-ssao-ssr", size).wants(&["a", "c"]).restless();
        setup.uniform("turning", 0.0).uniform("slices", slices).uniform("steps", steps)
    };
    match method {
        "horizons" => slices(),
        "gtao" => {
            let [first, last] = SECTORS;
            let left_out = format!("#if 0\n{first}");
            slices().edit("b", first, left_out).edit("b", last, format!("#endif{HIGHEST_HORIZON}"))
        }
        "rays" => ssao(0.0),
        "points" => ssao(1.0),
        _ => ssao(2.0),
    }
}

/// Returns a texel of a pass.
pub(super) fn texel(field: &Field, x: u32, y: u32) -> [f64; 4] {
    field.texels()[y as usize * field.width() + x as usize].map(f64::from)
}

/// Returns the part of the samples that something at a distance blocks: a sample of length s = radius (0.1 + 0.9 u u),
/// u uniform, detects things no farther than s.
pub(super) fn room_falloff(radius: f64, distance: f64) -> f64 {
    1.0 - ((distance / radius - 0.1).max(0.0) / 0.9).sqrt().min(1.0)
}
