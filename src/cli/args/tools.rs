//! Commands for other programs and for reports.

use super::values::PROJECT;
use crate::translate::{GlslVersion, Language};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(after_help = PROJECT)]
pub(crate) struct TranslateArgs {
    pub project: String,
    /// The language to write: wgsl, hlsl, msl, glsl or spirv
    #[arg(long, value_name = "LANGUAGE")]
    pub to: LanguageName,
    /// Version of GLSL: 330, 410, 450 or 300es [default: 450]
    #[arg(long, value_name = "VERSION", value_parser = glsl_version)]
    pub glsl_version: Option<GlslVersion>,
    /// Folder for the files [default: STEM-LANGUAGE in the current folder]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Overwrite existing files
    #[arg(long)]
    pub force: bool,
    /// Print one JSON object per line instead of text
    #[arg(long)]
    pub json: bool,
}

impl TranslateArgs {
    /// Returns the language with its version, or an error message if the options contradict each other.
    pub(crate) fn language(&self) -> Result<Language, String> {
        let language = match self.to {
            LanguageName::Wgsl => Language::Wgsl,
            LanguageName::Hlsl => Language::Hlsl,
            LanguageName::Msl => Language::Msl,
            LanguageName::Glsl => return Ok(Language::Glsl(self.glsl_version.unwrap_or_default())),
            LanguageName::Spirv => Language::Spirv,
        };
        match self.glsl_version {
            Some(_) => Err(format!("--glsl-version is for --to glsl, not for --to {}; leave it out", language.key())),
            None => Ok(language),
        }
    }
}

/// A language by its word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LanguageName {
    Wgsl,
    Hlsl,
    Msl,
    Glsl,
    Spirv,
}

fn glsl_version(text: &str) -> Result<GlslVersion, String> {
    let known = GlslVersion::ALL.into_iter().find(|version| version.key() == text);
    known.ok_or_else(|| format!("use one of {}", GlslVersion::ALL.map(GlslVersion::key).join(", ")))
}

#[derive(Debug, Args)]
pub(crate) struct DoctorArgs {
    /// Print one JSON object instead of text
    #[arg(long)]
    pub json: bool,
    /// Draw all presets, measure the graphics adapter, and write this JSON file for a bug report: about a minute. It
    /// contains no names of users, computers or folders (docs/gpu-reports.md)
    #[arg(long, value_name = "FILE", conflicts_with = "json")]
    pub report: Option<PathBuf>,
    /// Draw only this preset for the report; may be repeated
    #[arg(long, value_name = "PRESET", requires = "report")]
    pub preset: Vec<String>,
    /// Overwrite an existing report
    #[arg(long, requires = "report")]
    pub force: bool,
    /// Development only: panic, to try the report
    #[arg(long, hide = true)]
    pub panic: bool,
}

#[derive(Debug, Args)]
pub(crate) struct CompletionsArgs {
    /// The shell: bash, zsh, fish, powershell or elvish
    pub shell: clap_complete::Shell,
}

#[derive(Debug, Args)]
pub(crate) struct ManArgs {
    /// Folder for eddy.1 and a page per command
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Overwrite existing files
    #[arg(long)]
    pub force: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ListArgs {}

#[derive(Debug, Args)]
pub(crate) struct LspArgs {}

#[derive(Debug, Args)]
pub(crate) struct TryCompileArgs {}
