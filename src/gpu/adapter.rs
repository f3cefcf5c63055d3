//! The choice among the graphics adapters of a machine.

use super::{GpuError, opengl};

/// The adapter that a device is opened on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum AdapterChoice {
    /// A discrete GPU before an integrated one, and a processor last.
    #[default]
    HighPerformance,
    /// An integrated GPU before a discrete one.
    LowPower,
    /// The first one with this in its name, regardless of case.
    Named(String),
}

/// The environment variable with the name of the adapter, as in wgpu's own programs.
pub const ADAPTER_VARIABLE: &str = "WGPU_ADAPTER_NAME";

impl AdapterChoice {
    /// Returns the choice that a user writes: `high-performance`, `low-power` or a part of a name.
    pub fn parse(text: &str) -> Self {
        match text.trim() {
            "" | "high-performance" => AdapterChoice::HighPerformance,
            "low-power" => AdapterChoice::LowPower,
            name => AdapterChoice::Named(name.to_owned()),
        }
    }

    /// Returns the first of these choices that is written, or the default.
    pub fn first_of(written: impl IntoIterator<Item = Option<String>>) -> Self {
        written.into_iter().flatten().next().map_or_else(Self::default, |text| Self::parse(&text))
    }

    /// Returns the error for a choice that fits none of the adapters, with the reason of each instance.
    pub fn missing(&self, reasons: &[String]) -> GpuError {
        self.error(reasons, GpuError::NoAdapter)
    }

    /// Does the same for a choice that fits none of the adapters that draw on a window.
    pub fn missing_for_window(&self, reasons: &[String]) -> GpuError {
        self.error(reasons, GpuError::NoWindowAdapter)
    }

    fn error(&self, reasons: &[String], of: fn(String) -> GpuError) -> GpuError {
        let mut why: Vec<&str> = reasons.iter().map(String::as_str).collect();
        why.dedup();
        // An instance of another backend has others.
        if why.iter().any(|why| *why != NONE) {
            why.retain(|why| *why != NONE);
        }
        let why = why.join("; ");
        match self {
            AdapterChoice::Named(name) => GpuError::NoSuchAdapter { name: name.clone(), why },
            AdapterChoice::HighPerformance | AdapterChoice::LowPower => of(why),
        }
    }

    /// Returns an adapter of an instance that can draw on the surface, if there is one. The error is the end of a
    /// sentence about the instance's backends.
    pub fn choose(
        &self,
        instance: &wgpu::Instance,
        surface: Option<&wgpu::Surface<'_>>,
    ) -> Result<wgpu::Adapter, String> {
        let power_preference = match self {
            AdapterChoice::Named(name) => return named(instance, surface, name),
            AdapterChoice::HighPerformance => wgpu::PowerPreference::HighPerformance,
            AdapterChoice::LowPower => wgpu::PowerPreference::LowPower,
        };
        let options =
            wgpu::RequestAdapterOptions { power_preference, compatible_surface: surface, ..Default::default() };
        match pollster::block_on(instance.request_adapter(&options)) {
            Ok(adapter) => Ok(opengl::with_float_targets(instance, adapter)),
            Err(error) if surface.is_none() => Err(error.to_string()),
            Err(_) => Err(without_windows(instance)),
        }
    }
}

/// The reason of an instance without adapters.
const NONE: &str = "this machine has none";

/// Returns the reason why none of an instance's adapters draws on a window, as [`AdapterChoice::choose`] does.
pub fn without_windows(instance: &wgpu::Instance) -> String {
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
    let reason = |info: wgpu::AdapterInfo| format!("{} ({}) cannot draw on this window", info.name, info.backend);
    let reasons: Vec<String> = adapters.iter().map(|adapter| reason(adapter.get_info())).collect();
    if reasons.is_empty() { NONE.into() } else { reasons.join("; ") }
}

/// Returns the reason of an instance with these backends, for a list of the reasons of several.
pub fn of_backends(backends: wgpu::Backends, reason: String) -> String {
    use wgpu::Backends as B;
    let built = backends & wgpu::Instance::enabled_backend_features();
    let all = [(B::VULKAN, "Vulkan"), (B::METAL, "Metal"), (B::DX12, "Direct3D 12"), (B::GL, "OpenGL")];
    let names: Vec<&str> = all.iter().filter(|(backend, _)| built.contains(*backend)).map(|(_, name)| *name).collect();
    if reason == NONE { format!("no device for {}", names.join(" or ")) } else { reason }
}

fn named(instance: &wgpu::Instance, surface: Option<&wgpu::Surface<'_>>, name: &str) -> Result<wgpu::Adapter, String> {
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::all()));
    let names: Vec<String> = adapters.iter().map(|adapter| adapter.get_info().name).collect();
    let is_usable = |adapter: &wgpu::Adapter| surface.is_none_or(|surface| adapter.is_surface_supported(surface));
    let places = adapters.into_iter().zip(&names).filter(|(_, own)| is_named(own, name));
    match places.map(|(adapter, _)| adapter).find(is_usable) {
        Some(adapter) => Ok(opengl::with_float_targets(instance, adapter)),
        None if names.iter().any(|own| is_named(own, name)) => Err("it cannot draw on this window".into()),
        None if names.is_empty() => Err(NONE.into()),
        None => Err(format!("this machine has {}", names.join(", "))),
    }
}

fn is_named(own: &str, wanted: &str) -> bool {
    own.to_lowercase().contains(&wanted.to_lowercase())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Gpu, GpuOptions, testing};

    #[test]
    fn choices_are_a_preference_or_a_part_of_a_name() {
        assert_eq!(AdapterChoice::parse(" low-power "), AdapterChoice::LowPower);
        assert_eq!(AdapterChoice::parse("high-performance"), AdapterChoice::HighPerformance);
        assert_eq!(AdapterChoice::parse(""), AdapterChoice::HighPerformance);
        assert_eq!(AdapterChoice::parse("RTX 4090"), AdapterChoice::Named("RTX 4090".into()));
        assert!(is_named("NVIDIA GeForce RTX 4090", "rtx 4090") && !is_named("llvmpipe", "rtx"));
        let first = AdapterChoice::first_of([None, Some("low-power".into()), Some("b".into())]);
        assert_eq!((first, AdapterChoice::first_of([None])), (AdapterChoice::LowPower, AdapterChoice::HighPerformance));
    }

    #[test]
    fn an_adapter_is_found_by_its_name_and_a_wrong_name_lists_those_present() {
        let Some(gpu) = testing::gpu() else { return };
        let open =
            |name: &str| Gpu::new(&GpuOptions { adapter: AdapterChoice::Named(name.into()), ..GpuOptions::default() });
        let upper = gpu.info.name.to_uppercase();
        assert_eq!(open(&upper).unwrap().info.name, gpu.info.name);
        let Err(error @ GpuError::NoSuchAdapter { .. }) = open("no such adapter") else { panic!("it was opened") };
        let error = error.to_string();
        assert!(error.contains("has \"no such adapter\" in its name") && error.contains(&gpu.info.name), "{error}");
    }
}
