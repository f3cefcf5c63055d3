//! Shared parts of the tests of the built program: running it in a separate folder and reading its output files.

use super::gpu;
use std::{
    ffi::OsStr,
    fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

/// The result of a run of the program.
#[derive(Debug)]
pub(crate) struct Run {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Run {
    /// Returns standard output as JSON, one object per line.
    pub(crate) fn json(&self) -> Vec<serde_json::Value> {
        let parse = |line| serde_json::from_str(line).unwrap_or_else(|e| panic!("{line:?}: {e}\n{self:?}"));
        self.out.lines().map(parse).collect()
    }

    #[track_caller]
    pub(crate) fn expect(self, code: i32) -> Run {
        assert_eq!(self.code, Some(code), "standard output:\n{}\nstandard error:\n{}", self.out, self.err);
        assert!(!self.err.contains("panicked"), "{}", self.err);
        self
    }
}

/// A separate folder for one test, and the program run in it.
pub(crate) struct Bench {
    dir: tempfile::TempDir,
}

impl Bench {
    pub(crate) fn new() -> Bench {
        Bench { dir: tempfile::tempdir().unwrap() }
    }

    /// Returns `None` if the machine has no device.
    pub(crate) fn with_gpu() -> Option<Bench> {
        gpu().map(|_| Bench::new())
    }

    pub(crate) fn path(&self, name: impl AsRef<Path>) -> PathBuf {
        self.dir.path().join(name)
    }

    /// Writes a file, and creates its folders.
    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content).unwrap();
    }

    /// Writes an Image pass whose `mainImage` has this body.
    pub(crate) fn image(&self, name: &str, body: &str) {
        self.write(name, image(body));
    }

    pub(crate) fn command(&self) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_eddy"));
        command.current_dir(self.dir.path()).stdin(Stdio::null()).env_remove("RUST_BACKTRACE");
        command
    }

    pub(crate) fn eddy<S: AsRef<OsStr>>(&self, args: impl IntoIterator<Item = S>) -> Run {
        run(self.command().args(args))
    }

    /// Runs the program with arguments separated by spaces.
    pub(crate) fn line(&self, args: &str) -> Run {
        self.eddy(args.split_whitespace())
    }

    pub(crate) fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}; there are {:?}", self.names(".")))
    }

    /// Returns the sorted names of the files in a folder.
    pub(crate) fn names(&self, folder: &str) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(self.path(folder))
            .map(|d| d.map(|e| e.unwrap().file_name().into_string().unwrap()).collect())
            .unwrap_or_default();
        names.sort();
        names
    }

    pub(crate) fn npy(&self, name: &str) -> Npy {
        Npy::parse(&self.bytes(name))
    }

    pub(crate) fn png(&self, name: &str) -> image::RgbaImage {
        image::load_from_memory(&self.bytes(name)).unwrap().to_rgba8()
    }
}

pub(crate) fn image(body: &str) -> String {
    format!("void mainImage(out vec4 fragColor, in vec2 fragCoord) {{\n{body}\n}}\n")
}

pub(crate) fn run(command: &mut Command) -> Run {
    let output = command.output().unwrap_or_else(|e| panic!("{command:?}: {e}"));
    Run {
        code: output.status.code(),
        out: String::from_utf8(output.stdout).unwrap(),
        err: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}

/// A float picture, as written by `--format npy`. Row 0 is the bottom.
pub(crate) struct Npy {
    pub width: usize,
    pub height: usize,
    pub texels: Vec<[f32; 4]>,
}

impl Npy {
    fn parse(bytes: &[u8]) -> Npy {
        assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
        let data = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
        let header = std::str::from_utf8(&bytes[10..data]).unwrap();
        assert!(header.contains("'descr': '<f4'") && header.contains("'fortran_order': False"), "{header}");
        let shape = header.split_once("'shape': (").unwrap().1.split_once(')').unwrap().0;
        let shape: Vec<usize> = shape.split(',').map(|n| n.trim().parse().unwrap()).collect();
        assert_eq!((shape.len(), shape[2]), (3, 4), "{header}");
        let floats: Vec<f32> =
            bytes[data..].chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
        assert_eq!(floats.len(), shape[0] * shape[1] * 4);
        Npy {
            width: shape[1],
            height: shape[0],
            texels: floats.chunks_exact(4).map(|t| t.try_into().unwrap()).collect(),
        }
    }

    /// Returns a texel; `y` counts from the bottom.
    pub(crate) fn at(&self, x: usize, y: usize) -> [f32; 4] {
        self.texels[y * self.width + x]
    }
}
