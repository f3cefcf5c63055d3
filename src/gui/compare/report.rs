//! The report for scripts.

use super::{
    panel::{distance, speed_text},
    state::{Compare, HoveredPixel, View},
};
use crate::{
    lab::Number,
    session::{Session, Status},
};
use serde_json::{Value, json};

pub(super) fn report(state: &Compare, session: &Session) -> Value {
    let (name, why) = match session.comparison() {
        None => ("none", None),
        Some(Status::UnderWay(_)) => ("under way", None),
        Some(Status::Ended(Err(why))) => ("failed", Some(why)),
        Some(Status::Ended(Ok(_))) if state.is_measuring() => ("measuring", None),
        Some(Status::Ended(Ok(_))) => ("ended", None),
    };
    let figures = state.seen.as_ref().map(|seen| {
        let (comparison, apart) = (&seen.figures.comparison, &seen.figures.apart);
        json!({
            "against": comparison.against.name(),
            "pass": comparison.pass.title(),
            "frame": comparison.frame,
            "size": [comparison.ours.width, comparison.ours.height],
            "texels_apart": apart.texels_apart,
            "largest": Number(apart.largest),
            "rmse": Number(apart.rmse),
            "psnr": Number(apart.psnr),
            "ssim": apart.ssim,
            "flip": apart.mean_flip(),
            "ratio": seen.figures.times.map(|times| [times.ratio_low, times.ratio, times.ratio_high]),
            "words": [distance(apart, comparison), seen.figures.times.as_ref().map(speed_text).unwrap_or_default()],
        })
    });
    json!({
        "state": name,
        "why": why,
        "old": session.is_comparison_old(),
        "view": match state.view {
            View::Side => "side",
            View::Wipe => "wipe",
            View::Difference => "difference",
            View::Flip => "flip",
        },
        "wipe": state.wipe,
        "gain": state.gain,
        "figures": figures,
        "under": state.under.map(|HoveredPixel { texel: (x, y), ours, theirs }| {
            json!({ "texel": [x, y], "ours": ours, "theirs": theirs })
        }),
    })
}
