//! The state that the panel keeps from frame to frame.

use crate::{
    session::{Session, Status, TuneOptions, TuneOutcome},
    tune::{Bound, Point},
};
use egui::{ColorImage, TextureHandle, TextureOptions};
use serde_json::{Value, json};
use std::sync::Arc;

/// The time limit of a search in the window, in seconds.
const SECONDS: u64 = 60;

/// A picture on the window's device, and the setting that it shows.
struct Shown {
    values: Vec<f64>,
    texture: TextureHandle,
}

/// The state of the panel.
pub(crate) struct Speed {
    /// The bound as typed.
    pub(super) bound: String,
    pub(super) against_present: bool,
    /// The setting that is tried; `None`: the proposed one.
    pub(super) chosen: Option<Vec<f64>>,
    /// The button that shows the present setting is held.
    pub(super) is_compared: bool,
    shown: Option<Shown>,
    /// The result that `chosen` belongs to.
    of: Option<Arc<TuneOutcome>>,
}

impl Default for Speed {
    fn default() -> Self {
        Self {
            bound: Bound::DEFAULT.to_owned(),
            against_present: false,
            chosen: None,
            is_compared: false,
            shown: None,
            of: None,
        }
    }
}

impl Speed {
    /// Forgets the textures, whose device is lost. They are created again.
    pub(crate) fn forget_textures(&mut self) {
        self.shown = None;
    }

    /// Returns what a search is started with, or why it cannot be.
    pub(super) fn options(&self) -> Result<TuneOptions, String> {
        Bound::parse(&self.bound)?;
        Ok(TuneOptions { bound: self.bound.clone(), against_present: self.against_present, seconds: SECONDS })
    }

    /// Takes over the newest result.
    pub(super) fn update(&mut self, session: &Session) -> Option<Arc<TuneOutcome>> {
        let Some(Status::Ended(Ok(done))) = session.tuning() else { return None };
        if self.of.as_ref().is_none_or(|of| !Arc::ptr_eq(of, done)) {
            (self.of, self.chosen, self.shown) = (Some(done.clone()), None, None);
        }
        Some(done.clone())
    }

    /// Returns the setting that is tried: the chosen, the proposed or the present one.
    pub(super) fn tried<'o>(&self, outcome: &'o TuneOutcome) -> &'o Point {
        let tuning = &outcome.tuning;
        let proposed = tuning.proposal.as_ref().map(|proposal| &proposal.point.values);
        let values = self.chosen.as_ref().or(proposed);
        let find = |values: &Vec<f64>| tuning.points.iter().find(|point| point.values == *values);
        values.and_then(find).unwrap_or(&tuning.present)
    }

    /// Returns the picture of a setting; `None` if the search kept none.
    pub(super) fn picture(
        &mut self,
        ctx: &egui::Context,
        outcome: &TuneOutcome,
        values: &[f64],
    ) -> Option<&TextureHandle> {
        if self.shown.as_ref().is_none_or(|shown| shown.values != values) {
            let (_, picture) = outcome.tuning.pictures.iter().find(|(of, _)| of == values)?;
            let size = [picture.width as usize, picture.height as usize];
            let mut image = ColorImage::from_rgba_unmultiplied(size, &picture.bytes);
            // Alpha of a shader is no transparency.
            image.pixels.iter_mut().for_each(|pixel| *pixel = egui::Color32::from_rgb(pixel.r(), pixel.g(), pixel.b()));
            let texture = ctx.load_texture("speed", image, TextureOptions::LINEAR);
            self.shown = Some(Shown { values: values.to_vec(), texture });
        }
        self.shown.as_ref().map(|shown| &shown.texture)
    }
}

/// The report for scripts.
pub(super) fn report(state: &Speed, session: &Session) -> Value {
    let (name, why) = match session.tuning() {
        None => ("none", None),
        Some(Status::UnderWay(_)) => ("under way", None),
        Some(Status::Ended(Err(why))) => ("failed", Some(why)),
        Some(Status::Ended(Ok(_))) => ("ended", None),
    };
    let result = match session.tuning() {
        Some(Status::Ended(Ok(done))) => {
            let tuning = &done.tuning;
            let tried = state.tried(done);
            json!({
                "points": tuning.points.len(),
                "frontier": tuning.frontier().len(),
                "knobs": tuning.knobs.iter().map(|knob| &knob.name).collect::<Vec<_>>(),
                "present": { "ms": tuning.present.millis, "values": tuning.present.values },
                "tried": { "ms": tried.millis, "values": tried.values },
                "speed_up": tuning.proposal.as_ref().map(crate::tune::Proposal::speed_up),
            })
        }
        _ => Value::Null,
    };
    json!({ "state": name, "why": why, "bound": state.bound, "old": session.is_tuning_old(), "result": result })
}
