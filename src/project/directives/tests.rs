//! Tests of `#iChannel` lines.

use super::{read::Declared, *};
use crate::{Channel, PassName};
use crate::{Filter, Input, InputKind, Media, Sampler, Wrap};
use eddy_diag::SourceId;

/// Reads a text of Buffer A in a project with Buffer B and Image.
fn of_a(text: &str) -> Declared {
    let id = PassName::buffer("A");
    let passes = [("buffer_a.glsl", id.clone()), ("buffer_b.glsl", PassName::buffer("B"))];
    let passes: Vec<(String, PassName)> = passes.into_iter().map(|(file, id)| (file.to_owned(), id)).collect();
    read(text, SourceId(3), DirectiveScope { id: &id, file: "buffer_a.glsl", passes: &passes }, &Default::default())
}

fn channels(text: &str) -> crate::Bindings {
    let d = of_a(text);
    assert_eq!(d.diagnostics, []);
    d.channels.unwrap()
}

#[test]
fn directives_name_inputs_and_samplers() {
    let c = channels(
        "#iChannel0::WrapMode \"Repeat\"\n#iChannel0 \"self\"\n#iChannel1 \"file://sub/pic.png\" // note\n\
         #iChannel1::MinFilter \"Nearest\"\r\n#iChannel2 \"keyboard\"\n#iChannel3 \"file://Buffer_B.glsl\"\n",
    );
    assert_eq!(
        c.get(0),
        Some(&Channel { input: Input::buffer("A"), sampler: Sampler { wrap: Wrap::Repeat, ..Sampler::BUFFER } })
    );
    assert_eq!(
        c.get(1),
        Some(&Channel {
            input: Input::texture(Media::File("sub/pic.png".into())),
            sampler: Sampler { filter: Filter::Nearest, ..Sampler::TEXTURE }
        })
    );
    assert_eq!(c.get(2).unwrap().input, Input::KEYBOARD);
    assert_eq!(c.get(3).unwrap().input, Input::buffer("B"));
}

#[test]
fn music_is_recognised_by_its_extension() {
    let c = channels("#iChannel0 \"file://sub/song.MP3\"\n#iChannel1 \"tune.ogg\"\n#iChannel2 \"Microphone\"\n");
    let music = |path: &str| Input::Media { kind: InputKind::Music, media: Media::File(path.into()) };
    let read: Vec<(usize, Input)> = c.iter().map(|(slot, channel)| (slot, channel.input.clone())).collect();
    let microphone = Input::Device(InputKind::Microphone);
    assert_eq!(read, [(0, music("sub/song.MP3")), (1, music("tune.ogg")), (2, microphone)]);
}

#[test]
fn a_text_without_directives_declares_nothing() {
    let d = of_a("/*\n#iChannel0 \"self\"\n*/ // #iChannel1 \"self\"\nvoid f(){}");
    assert!(d.channels.is_none() && d.diagnostics.is_empty());
}

#[test]
fn blanking_preserves_all_other_bytes() {
    let text = "\u{feff}a\n#iChannel0 \"file://é.png\"\r\nb // #iChannel0\n#define iChannel0 x\n";
    let out = blank(text);
    assert_eq!(out.len(), text.len());
    assert_eq!(out.find("\r\nb // #iChannel0\n#define"), text.find("\r\nb // #iChannel0\n#define"));
    assert!(!out.contains(".png") && !out.contains('\u{feff}'));
    assert!(matches!(blank("plain\n#define X\n"), Cow::Borrowed(_)));
    assert_eq!(blank("\u{feff}#iChannel0 \"self\"").trim(), "");
}

#[test]
fn invalid_directives_have_a_span_and_a_fix() {
    for (line, message, hint) in [
        ("#iChannel4 \"self\"", "there is no iChannel4", "write #i"),
        ("#iChannel0 self", "double quotes", "write #i"),
        ("#iChannel0 \"self", "double quotes", "write #i"),
        ("#iChannel0 \"keybord\"", "not an input that a channel can read", "keyboard"),
        ("#iChannel0 \"image\"", "cannot read Image", "a channel can read buffers"),
        ("#iChannel0 \"https://x/y.png\"", "not downloaded", "file://pic.png"),
        ("#iChannel0 \"self\"\n#iChannel0::WrapMode \"Mirror\"", "unknown wrap mode", "Clamp and Repeat"),
        ("#iChannel0 \"self\"\n#iChannel0::WrapMod \"Clamp\"", "unknown setting", "WrapMode"),
        ("#iChannel0::WrapMode \"Clamp\"", "has no input", "add its input"),
        ("#iChannel0 'self'", "double quotes", "write #i"),
        ("#iChannel0 <self>", "double quotes", "write #i"),
        ("#iChannel0", "double quotes", "write #i"),
        ("#iChannel0 \"\"", "not an input that a channel can read", "\"self\""),
        ("#iChannel0 \"file://\"", "not an input that a channel can read", "\"self\""),
        ("#iChannel0 \"self\" \"self\"", "double quotes", "write #i"),
        ("#iChannel10 \"self\"", "there is no iChannel10", "write #i"),
        ("#iChannel0 \"file://buffer_c.glsl\"", "not a pass of this project", "put the file there"),
        ("#iChannel0 \"buffer_z.glsl\"", "not a pass of this project", "did you mean \"buffer_a.glsl\"?"),
        ("#iChannel0 \"self\"\n#iChannel0::Type \"CubeMap\"", "cannot read a cubemap", "cube_a"),
        ("#iChannel0 \"self\"\n#iChannel0::MinFilter \"Nearer\"", "unknown filter", "Nearest"),
    ] {
        let text = format!("\n{line}");
        let d = of_a(&text).diagnostics;
        assert_eq!(d.len(), 1, "{line}: {d:?}");
        assert!(d[0].message.contains(message), "{line}: {}", d[0].message);
        assert!(d[0].hints.iter().any(|h| h.contains(hint)), "{line}: {:?}", d[0].hints);
        let span = d[0].span.unwrap();
        assert!(text[span.range()].starts_with("#iChannel") && span.source == SourceId(3));
    }
}

#[test]
fn every_spelling_of_a_pass_is_accepted() {
    for (value, buffer) in [
        ("self", "A"),
        ("Self", "A"),
        ("file://self", "A"),
        ("self.glsl", "A"),
        ("buffer_a.glsl", "A"),
        ("file://./buffer_a.glsl", "A"),
        ("sub/../buffer_a.glsl", "A"),
        ("buffer_b", "B"),
        ("./buffer_b.glsl", "B"),
        ("file://Buffer_B.glsl", "B"),
        ("file://other/buffer_b.glsl", "B"),
    ] {
        let read = channels(&format!("#iChannel2 \"{value}\"\n"));
        assert_eq!(read.get(2).map(|c| &c.input), Some(&Input::buffer(buffer)), "{value}");
    }
}

#[test]
fn a_setting_without_an_input_applies_to_the_default_channel() {
    let id = PassName::image();
    let around = DirectiveScope { id: &id, file: "image.glsl", passes: &[] };
    let usual = [Some(Channel::new(Input::buffer("A")))].into();
    let found = read("#iChannel0::WrapMode \"Repeat\"\n", SourceId(1), around, &usual);
    assert_eq!(found.diagnostics, []);
    let first = found.channels.unwrap().get(0).cloned().unwrap();
    assert_eq!((first.input, first.sampler.wrap), (Input::buffer("A"), Wrap::Repeat));
}

#[test]
fn a_channel_that_is_set_twice_is_reported() {
    let said = of_a("#iChannel0 \"self\"\n#iChannel0 \"buffer_b\"\n#iChannel1 \"self\"\n#iChannel1 \"buffer_a\"\n");
    assert_eq!(said.diagnostics.len(), 1, "two lines that say the same do no harm: {:?}", said.diagnostics);
    assert!(said.diagnostics[0].message.contains("iChannel0") && said.diagnostics[0].labels.len() == 1);
    assert_eq!(said.channels.unwrap().get(0).unwrap().input, Input::buffer("B"));
}

#[test]
fn unused_channel_lines_become_comments() {
    let text = "/* a */ #iChannel0 \"self\"\n // #iChannel1 \"self\"\n#define A\n";
    let said = "/* a */ // #iChannel0 \"self\"\n // #iChannel1 \"self\"\n#define A\n";
    assert_eq!(commented(text), said);
    assert!(matches!(commented(said), Cow::Borrowed(_)));
}
