//! The microphone: enabled by the user, open while a channel reads it.

use super::{Audio, News, news};
use crate::{
    open_project::OpenProject,
    view::{About, Level},
};
use eddy_audio::Spectrum;
use eddy_project::{Input, InputKind, Pass};
use std::sync::Arc;

/// Returns whether a channel of a pass reads the microphone.
pub(super) fn reads_it(pass: &Pass) -> bool {
    pass.bindings.channels().any(|channel| channel.input == Input::Device(InputKind::Microphone))
}

impl Audio {
    /// Returns the spectrum that a frame reads. A frame that is drawn while time is paused (`is_new` is false) reads
    /// the spectrum of the previous one.
    pub(crate) fn spectrum(&mut self, is_new: bool) -> Option<Arc<Spectrum>> {
        if !self.is_recording {
            self.spectrum = None;
        } else if is_new && let Some(microphone) = &mut self.microphone {
            self.spectrum = microphone.frame();
        }
        self.spectrum.clone()
    }
}

impl Audio {
    pub(crate) fn use_microphone(&mut self, open: &mut OpenProject, on: bool) {
        self.uses_microphone = on;
        open.dismiss_notices(About::Microphone);
        self.input_is_missing = false;
        self.hear(open);
    }

    /// Takes what the microphone has recorded, before frames are drawn.
    pub(crate) fn hear(&mut self, open: &mut OpenProject) {
        self.reads_microphone = self.uses_microphone && open.documents.current().passes.iter().any(reads_it);
        let is_wanted = self.reads_microphone;
        if !is_wanted && std::mem::take(&mut self.input_is_missing) {
            open.dismiss_notices(About::Microphone);
        }
        if is_wanted != self.is_recording
            && let Some(microphone) = self.microphone(&open.host.wake)
        {
            microphone.switch(is_wanted);
            self.is_recording = is_wanted;
        }
        let Some(microphone) = &mut self.microphone else { return };
        microphone.step(open.host.now);
        if !is_wanted {
            return;
        }
        match news(microphone.state(), &mut self.input_is_missing) {
            Some(News::Missing(why)) => {
                let text = format!(
                    "the microphone cannot be used: {why}. Its channel shows a made-up spectrum; Eddy tries again every 3 \
                     seconds"
                );
                open.notice_about(About::Microphone, Level::Warning, text);
            }
            Some(News::Back(_) | News::Over) => open.dismiss_notices(About::Microphone),
            None => {}
        }
    }
}
