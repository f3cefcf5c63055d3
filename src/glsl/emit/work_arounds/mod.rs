//! Work-arounds for drivers, as changes of the program before it is emitted. Each file names the driver and its fault,
//! or the feature that the device lacks. None of them changes what a terminating program computes.
//! ([`super::long_arrays`] is the only one that changes the emitted module.)

mod angles;
mod counters;
mod discard_exits;
mod discards;
mod endless_loops;
mod filtering;
mod limits;
mod loop_exits;
mod loop_steps;
mod small_arrays;
mod uniforms;
mod zero_divisors;

use crate::{PassKind, PassSource, ir::Module};

/// Applies the work-arounds that a device and its driver need.
pub(crate) fn apply(program: &mut Module, source: &PassSource<'_>) {
    let &PassSource { kind, driver, bilinear_in_shader, .. } = source;
    if driver.small_arrays {
        small_arrays::run(program);
    }
    if let Some(limit) = driver.max_loop_iterations {
        endless_loops::run(program, limit);
    }
    loop_steps::run(program);
    zero_divisors::run(program);
    if driver.nan_angle {
        angles::run(program);
    }
    if bilinear_in_shader.contains(&true) {
        filtering::run(program, bilinear_in_shader);
    }
    if driver.opaque_limits {
        limits::run(program);
    }
    if driver.opaque_counters {
        counters::run(program);
    }
    if driver.discard_exits {
        discard_exits::run(program);
    }
    if driver.loop_closing_exits {
        loop_exits::run(program);
    }
    if driver.opaque_uniforms {
        uniforms::run(program);
    }
    if driver.may_discard && kind == PassKind::Fragment {
        discards::run(program);
    }
}
