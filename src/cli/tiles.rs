//! Pictures that are drawn in tiles: the decision to use tiles, and writing the tiles to files.

use super::{
    args::{RenderArgs, RunArgs},
    machine::RunError,
    memory,
};
use crate::{
    engine::{FrameInputs, Pixels},
    film::{Mean, Output, Still, StripWriter, shrunk},
    gpu::Gpu,
    playback::{
        offline::{Offline, OfflineError},
        scene::Scene,
        tiles::Tiling,
    },
    project::limits::{FILM_FRAME_BYTES, TILED_SIDE, WHOLE_PIXELS},
};
use std::ops::Range;

/// The choice of tiles for the written pass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Tiles {
    #[default]
    Never,
    /// Uses tiles if the picture is too large to be drawn in one piece, or would need too much memory. Strips have a
    /// multiple of this number of rows.
    Large(u32),
    /// Always uses tiles, with this number of pixels along each side.
    Always(u32, u32),
}

/// The decision for one picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TilePolicy {
    /// In one piece.
    Never,
    /// In tiles if possible; otherwise in one piece.
    Preferred(Tiling),
    /// Only in tiles.
    Required(Tiling),
}

impl TilePolicy {
    pub(super) fn tiling(self) -> Option<Tiling> {
        match self {
            TilePolicy::Never => None,
            TilePolicy::Preferred(tiling) | TilePolicy::Required(tiling) => Some(tiling),
        }
    }
}

/// Decides how the pictures of a run are drawn. `is_measured`: other code reads the whole picture.
pub(super) fn policy(run: &RunArgs, gpu: &Gpu, is_measured: bool) -> Result<TilePolicy, RunError> {
    let recorded = run.replay.iter().flat_map(|recording| recording.frames.iter().map(|frame| frame.size));
    let sides = recorded.chain([run.size]).fold((0, 0), |(w, h), size| (w.max(size.0), h.max(size.1)));
    let limit = gpu.device.limits().max_texture_dimension_2d;
    let (is_too_large, pixels) = (sides.0.max(sides.1) > limit, u64::from(sides.0) * u64::from(sides.1));
    let (side, factor) = match run.tiles {
        Tiles::Never => return Ok(TilePolicy::Never),
        Tiles::Large(factor) if is_too_large || pixels > WHOLE_PIXELS => (None, factor),
        Tiles::Large(_) => return Ok(TilePolicy::Never),
        Tiles::Always(side, factor) => (Some(side), factor),
    };
    let refused = |why: &str| -> Result<TilePolicy, RunError> {
        if side.is_none() && !is_too_large {
            return Ok(TilePolicy::Never);
        }
        let what = match side {
            Some(_) => "--tile".into(),
            None => format!("this device draws at most {limit}x{limit} pixels in one piece"),
        };
        Err(anyhow::anyhow!("{what}: {why}").into())
    };
    if run.no_skip {
        return refused("--no-skip draws every pass in one piece; leave it out");
    }
    if is_measured {
        return refused("a picture in tiles cannot be measured; remove its --probe, --assert and //@probe comments");
    }
    if sides.0.max(sides.1) > TILED_SIDE {
        let what =
            format!("a picture of {}x{} pixels: it can have at most {TILED_SIDE} across or up", sides.0, sides.1);
        return Err(anyhow::anyhow!(what).into());
    }
    let tiling = Tiling::new(side, limit, factor);
    Ok(if side.is_none() && !is_too_large { TilePolicy::Preferred(tiling) } else { TilePolicy::Required(tiling) })
}

/// Returns the size of the written picture of a project that is drawn in tiles.
pub(super) fn size(offline: &Offline, args: &RenderArgs) -> Result<(u32, u32), RunError> {
    let (width, height) = offline.engine()?.tiles().map_or((0, 0), |(picture, _)| picture);
    Ok((width / args.factor(), height / args.factor()))
}

/// Draws rows of a picture. `parts`: the frame's inputs, if it is the mean of several pictures.
fn strip(
    offline: &mut Offline,
    args: &RenderArgs,
    parts: Option<&FrameInputs>,
    rows: Range<u32>,
) -> Result<Pixels, RunError> {
    let drawn = match (parts, args.shutter) {
        (Some(inputs), Some(shutter)) => {
            let mut mean = Mean::default();
            offline.draw_parts_of(inputs, args.samples, shutter / args.run.fps(), |offline| {
                mean.add(&offline.draw_strip(rows.clone())?);
                Ok::<_, OfflineError>(())
            })?;
            mean.take()
        }
        _ => offline.draw_strip(rows)?,
    };
    Ok(if args.factor() == 1 { drawn } else { shrunk(&drawn, args.factor()) })
}

fn strips(offline: &Offline, top_first: bool) -> Result<Vec<Range<u32>>, RunError> {
    let picture = offline.engine()?.tiles().map(|(picture, _)| picture);
    Ok(offline.tiling().zip(picture).map_or_else(Vec::new, |(tiling, picture)| tiling.strips(picture, top_first)))
}

/// Draws the whole picture of the newest frame and discards it.
pub(super) fn draw_all(offline: &mut Offline) -> Result<(), RunError> {
    for rows in strips(offline, true)? {
        offline.draw_strip(rows)?;
    }
    Ok(())
}

/// Returns the whole picture of the newest frame, in tiles or not, in its written form.
pub(super) fn whole(offline: &mut Offline, args: &RenderArgs, parts: Option<&FrameInputs>) -> Result<Pixels, RunError> {
    if offline.tiling().is_none() {
        let pixels = offline.read(&args.pass.pass, args.face.unwrap_or(args.pass.target))?;
        return Ok(if args.factor() == 1 { pixels } else { shrunk(&pixels, args.factor()) });
    }
    let (width, height) = size(offline, args)?;
    let bytes = u64::from(width) * u64::from(height) * 16;
    if bytes > FILM_FRAME_BYTES {
        let what = anyhow::anyhow!(
            "a frame of a film is encoded in one piece, and one of {width}x{height} pixels takes {}, more than {}: write \
             png, exr or npy files, or choose a smaller resolution",
            memory::gibibytes(bytes),
            memory::gibibytes(FILM_FRAME_BYTES)
        );
        return Err(what.into());
    }
    let mut texels = Vec::with_capacity(width as usize * height as usize);
    for rows in strips(offline, false)? {
        texels.append(&mut strip(offline, args, parts, rows)?.texels);
    }
    Ok(Pixels { width, height, texels })
}

/// Draws the newest frame's picture and writes it at the same time.
pub(super) fn write(
    offline: &mut Offline,
    args: &RenderArgs,
    parts: Option<&FrameInputs>,
    still: Still,
    output: Output,
    scene: Option<Scene>,
) -> Result<(), RunError> {
    let size = size(offline, args)?;
    if matches!(output, Output::Pipe(_)) && !still.is_for_pipes_in_strips() {
        return Err(anyhow::anyhow!("--out -: an exr picture that is drawn in tiles needs a file").into());
    }
    let texels = offline.engine()?.format(&args.pass.pass, args.pass.target).unwrap_or_default();
    let failed = |error| RunError::Other(anyhow::Error::from(error));
    let mut writer = StripWriter::start(still, texels, size, output, scene).map_err(failed)?;
    for rows in strips(offline, still.is_top_first())? {
        writer.push(strip(offline, args, parts, rows)?).map_err(failed)?;
    }
    writer.finish().map_err(failed)
}
