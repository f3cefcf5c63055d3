//! The compiler that turns HLSL into programs for Direct3D 12.
//!
//! wgpu uses `dxcompiler.dll` (DXC), which the program has loaded from its own folder or one of the search path, and else
//! `d3dcompiler_47.dll` (FXC), which is a part of Windows. FXC unrolls loops, and takes minutes for shaders that DXC compiles
//! in seconds.

/// The compiler of shaders on Direct3D 12.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum HlslCompiler {
    /// DXC, with the path of its library.
    Dxc(String),
    /// FXC.
    Fxc,
}

/// The library of DXC.
#[cfg(windows)]
const DXC: &str = "dxcompiler.dll";

impl HlslCompiler {
    /// Returns the compiler that a device of this backend uses; `None` if the backend is not Direct3D 12. wgpu does not report
    /// its choice. It has loaded the library of DXC if it uses it.
    pub(super) fn of(backend: wgpu::Backend) -> Option<Self> {
        (backend == wgpu::Backend::Dx12).then(|| Self::of_library(loaded_dxc()))
    }

    fn of_library(dxc: Option<String>) -> Self {
        dxc.map_or(HlslCompiler::Fxc, HlslCompiler::Dxc)
    }

    /// Returns its name, and the path of its library if that is not a part of Windows.
    pub fn describe(&self) -> String {
        match self {
            HlslCompiler::Dxc(path) => format!("DXC ({path})"),
            HlslCompiler::Fxc => "FXC".into(),
        }
    }

    /// Returns a warning if it is slow, with the fix.
    pub fn warning(&self) -> Option<&'static str> {
        match self {
            HlslCompiler::Dxc(_) => None,
            HlslCompiler::Fxc => Some(
                "Direct3D 12 compiles shaders by FXC here, which takes minutes for some: put dxcompiler.dll, version 1.8.2502 \
                 or newer, beside eddy.exe (https://github.com/microsoft/DirectXShaderCompiler/releases)",
            ),
        }
    }
}

/// Returns the path of the library of DXC if it is loaded.
#[cfg(windows)]
fn loaded_dxc() -> Option<String> {
    use windows_sys::Win32::System::LibraryLoader::{GetModuleFileNameW, GetModuleHandleW};
    let name: Vec<u16> = DXC.encode_utf16().chain([0]).collect();
    // SAFETY: the name ends with 0.
    let module = unsafe { GetModuleHandleW(name.as_ptr()) };
    if module.is_null() {
        return None;
    }
    // The longest path that Windows has.
    let mut path = vec![0; 1 << 15];
    // SAFETY: the library stays loaded as long as wgpu's instance, and the buffer has this length.
    let length = unsafe { GetModuleFileNameW(module, path.as_mut_ptr(), path.len() as u32) };
    Some(String::from_utf16_lossy(&path[..length as usize]))
}

#[cfg(not(windows))]
fn loaded_dxc() -> Option<String> {
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn direct3d_alone_has_a_compiler_and_the_slow_one_is_a_warning() {
        assert_eq!([wgpu::Backend::Vulkan, wgpu::Backend::Gl].map(HlslCompiler::of), [None, None]);
        assert_eq!(HlslCompiler::of(wgpu::Backend::Dx12), Some(HlslCompiler::Fxc), "no library of DXC is loaded");
        let dxc = HlslCompiler::of_library(Some("C:\\Eddy\\dxcompiler.dll".into()));
        assert_eq!((dxc.describe().as_str(), dxc.warning()), ("DXC (C:\\Eddy\\dxcompiler.dll)", None));
        let warning = HlslCompiler::Fxc.warning().expect("FXC is slow");
        assert!(warning.contains("dxcompiler.dll") && warning.contains("beside eddy.exe"), "{warning}");
    }
}
