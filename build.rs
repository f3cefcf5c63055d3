//! Embeds the icon and the manifest into the program for Windows. For other systems it does nothing.
//!
//! The resources are written as a `.res` file, which Microsoft's linker takes as it is. For that of MinGW, `windres`
//! converts it, which every MinGW has beside its compiler.

use std::{env, fs, path::Path, process::Command};

const ICON: &str = "packaging/icon/eddy.ico";
const MANIFEST: &str = "packaging/windows/eddy.manifest";

/// The types of resources (`RT_ICON`, `RT_GROUP_ICON`, `RT_MANIFEST`).
const TYPE_ICON: u16 = 3;
const TYPE_GROUP_ICON: u16 = 14;
const TYPE_MANIFEST: u16 = 24;

fn main() {
    for file in ["build.rs", ICON, MANIFEST] {
        println!("cargo::rerun-if-changed={file}");
    }
    let variable = |name: &str| env::var(name).unwrap_or_default();
    if variable("CARGO_CFG_TARGET_OS") != "windows" {
        return;
    }
    let icon = fs::read(ICON).expect("the icon is in the repository");
    let manifest = fs::read(MANIFEST).expect("the manifest is in the repository");
    let out = variable("OUT_DIR");
    let resources = Path::new(&out).join("eddy.res");
    fs::write(&resources, resource_file(&icon, &manifest)).expect("cargo's folder can be written");
    if variable("CARGO_CFG_TARGET_ENV") == "msvc" {
        println!("cargo::rustc-link-arg-bins={}", resources.display());
        return;
    }
    let object = Path::new(&out).join("eddy-resources.o");
    let prefixed = format!("{}-w64-mingw32-windres", variable("CARGO_CFG_TARGET_ARCH"));
    let convert = |program: &str| {
        let mut command = Command::new(program);
        command.args(["--input-format=res", "--output-format=coff"]).arg(&resources).arg(&object);
        command.status().is_ok_and(|status| status.success())
    };
    if convert(&prefixed) || convert("windres") {
        println!("cargo::rustc-link-arg-bins={}", object.display());
    } else {
        println!("cargo::warning=neither {prefixed} nor windres runs: eddy.exe has no icon and no manifest");
    }
}

/// Returns a file of resources: the images of the icon, the list of them, and the manifest.
fn resource_file(icon: &[u8], manifest: &[u8]) -> Vec<u8> {
    // The first resource is empty, by which linkers recognise the format.
    let mut file = resource(0, 0, &[]);
    // An icon has a header of three words, the last of which is the number of images, and 16 bytes for each image. Its list as
    // a resource has the number of the image's resource in place of its position in the file.
    let number = |at: usize| u32::from_le_bytes(icon[at..at + 4].try_into().expect("four bytes")) as usize;
    let count = u16::from_le_bytes([icon[4], icon[5]]);
    let mut list = icon[..6].to_vec();
    for image in 1..=count {
        let entry = 6 + 16 * (usize::from(image) - 1);
        let (length, position) = (number(entry + 8), number(entry + 12));
        file.extend(resource(TYPE_ICON, image, &icon[position..position + length]));
        list.extend(&icon[entry..entry + 12]);
        list.extend(image.to_le_bytes());
    }
    file.extend(resource(TYPE_GROUP_ICON, 1, &list));
    file.extend(resource(TYPE_MANIFEST, 1, manifest));
    file
}

/// Returns a resource with its header (`RESOURCEHEADER`), as long as a multiple of four bytes. Type and name are numbers.
fn resource(kind: u16, name: u16, data: &[u8]) -> Vec<u8> {
    const HEADER: u32 = 32;
    const IS_NUMBER: u16 = 0xffff;
    const ENGLISH: u16 = 0x0409;
    let mut bytes = Vec::new();
    bytes.extend((data.len() as u32).to_le_bytes());
    bytes.extend(HEADER.to_le_bytes());
    [IS_NUMBER, kind, IS_NUMBER, name].iter().for_each(|word| bytes.extend(word.to_le_bytes()));
    // The version of the data, and flags that have no meaning any more.
    bytes.extend([0; 6]);
    bytes.extend((if kind == 0 { 0 } else { ENGLISH }).to_le_bytes());
    // Version and characteristics, which are the author's.
    bytes.extend([0; 8]);
    bytes.extend(data);
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    bytes
}
