//! Painting only the damage of a window results in the same bytes as painting it whole.

use super::{BackBuffer, Painting, paint_areas};
use crate::{
    gpu::{Gpu, Readback, Texture, TextureDescriptor, TextureShape, testing},
    gui::{damage::Area, frame, shell::Shell, theme},
    project::TexelFormat,
    session::{FileCommand, Session, SessionOptions},
};
use egui::{Event, Key, Modifiers, PointerButton, Pos2, RawInput, Rect, ViewportId, pos2, vec2};
use egui_wgpu::{Renderer, ScreenDescriptor};
use std::{sync::Arc, time::Instant};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// A deterministic sequence of random numbers from 0 to 1.
struct Random(u32);

impl Random {
    fn part(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (self.0 >> 8) as f32 / (1 << 24) as f32
    }

    fn of<T: Copy>(&mut self, list: &[T]) -> T {
        list[(self.part() * list.len() as f32) as usize]
    }
}

/// Paints in both ways, side by side.
struct Painter {
    gpu: Gpu,
    renderer: Renderer,
    back_buffer: BackBuffer,
    readback: Readback,
    /// The numbers of pixels that were painted, and of those in whole windows.
    painted: [u64; 2],
}

impl Painter {
    fn texture(&self, [width, height]: [u32; 2]) -> Texture {
        let descriptor = TextureDescriptor {
            label: "test",
            shape: TextureShape::flat(width, height, TexelFormat::Rgba8),
            is_target: true,
        };
        Texture::new(&self.gpu, &descriptor).unwrap()
    }

    fn submit(&self, encoder: wgpu::CommandEncoder, mut commands: Vec<wgpu::CommandBuffer>) {
        commands.push(encoder.finish());
        self.gpu.queue.submit(commands);
    }

    /// Returns the bytes of both paintings.
    fn paint(&mut self, ctx: &egui::Context, output: egui::FullOutput, size: [u32; 2]) -> [Vec<u8>; 2] {
        let egui::FullOutput { shapes, pixels_per_point, mut textures_delta, .. } = output;
        for (id, deltas) in textures_delta.set.drain() {
            for delta in deltas {
                self.renderer.update_texture(&self.gpu.device, &self.gpu.queue, id, &delta);
                self.back_buffer.update(id, &delta);
            }
        }
        let triangles = ctx.tessellate(shapes, pixels_per_point);
        let screen = &ScreenDescriptor { size_in_pixels: size, pixels_per_point };
        let pixels = |area: &Area| u64::from(area.width) * u64::from(area.height);
        let BackBuffer { damage, versions, .. } = &self.back_buffer;
        let areas = damage.clone().of(&triangles, size, pixels_per_point, versions);
        self.painted[0] += areas.iter().map(pixels).sum::<u64>();
        let area = [Area { x: 0, y: 0, width: size[0], height: size[1] }];
        self.painted[1] += pixels(&area[0]);
        let (parts, whole) = (self.texture(size), self.texture(size));
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let painting = Painting { triangles: triangles.clone(), screen, format: FORMAT };
        let (contents, commands) = self.back_buffer.paint(&self.gpu, &mut self.renderer, &mut encoder, painting);
        encoder.copy_texture_to_texture(contents.as_image_copy(), parts.raw.as_image_copy(), contents.size());
        self.submit(encoder, commands);
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let commands =
            paint_areas(&self.gpu, &mut self.renderer, &mut encoder, &whole.level_0, triangles, screen, &area);
        self.submit(encoder, commands);
        let bytes = [&parts, &whole].map(|texture| self.readback.rgba8(&self.gpu, texture).unwrap());
        for id in textures_delta.free.drain() {
            self.renderer.free_texture(&id);
        }
        bytes
    }
}

/// Returns random input events for one frame.
fn events(random: &mut Random, size: [f32; 2], places: &[Pos2]) -> Vec<Event> {
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    let key = |key, modifiers| Event::Key { key, physical_key: None, pressed: true, repeat: false, modifiers };
    let anywhere = pos2(random.part() * size[0], random.part() * size[1]);
    match (random.part() * 10.0) as u32 {
        0..3 => vec![Event::PointerMoved(anywhere)],
        3 | 4 => vec![Event::PointerMoved(anywhere), button(anywhere, true), button(anywhere, false)],
        5 => {
            let at = random.of(places);
            vec![Event::PointerMoved(at), button(at, true), button(at, false)]
        }
        6 | 7 => vec![Event::Text("float x = 1.5; // ".to_owned())],
        8 => vec![key(Key::P, Modifiers::COMMAND | Modifiers::SHIFT)],
        _ => vec![key(random.of(&[Key::Escape, Key::Enter, Key::Backspace]), Modifiers::NONE)],
    }
}

/// Separate tests, so that they run in parallel.
#[test]
fn painting_the_damage_equals_painting_the_whole() {
    paint_both((1.0, [900, 600], 1));
}

#[test]
fn painting_the_damage_equals_painting_the_whole_at_a_fractional_scale() {
    paint_both((1.25, [903, 601], 2));
}

#[test]
fn painting_the_damage_equals_painting_the_whole_at_a_double_scale() {
    paint_both((2.0, [1000, 700], 3));
}

fn paint_both((scale, size, seed): (f32, [u32; 2], u32)) {
    let Some(gpu) = testing::gpu() else { return };
    let folder = tempfile::tempdir().unwrap();
    let moving = "void mainImage(out vec4 o, in vec2 p) { o = vec4(p / iResolution.xy, sin(iTime), 1); }";
    std::fs::write(folder.path().join("image.glsl"), moving).unwrap();
    let mut session = Session::with_options(gpu.clone(), Arc::new(|| ()), SessionOptions::default()).unwrap();
    session.apply(FileCommand::Open(folder.path().display().to_string()));
    let renderer = Renderer::new(&gpu.device, FORMAT, Default::default());
    let mut painter = Painter {
        gpu: gpu.clone(),
        renderer,
        back_buffer: BackBuffer::default(),
        readback: Readback::default(),
        painted: [0; 2],
    };
    let mut shell = Shell::new(gpu.clone(), Arc::new(|| ()), false);
    let ctx = egui::Context::default();
    theme::apply(&ctx);
    let mut random = Random(seed);
    let points = size.map(|pixels| pixels as f32 / scale);
    for turn in 0..40 {
        let mut input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, vec2(points[0], points[1]))),
            // Animations run at their own rate.
            time: Some(f64::from(turn) / 30.0),
            ..RawInput::default()
        };
        input.viewports.get_mut(&ViewportId::ROOT).unwrap().native_pixels_per_point = Some(scale);
        let places: Vec<Pos2> = ["code", "viewport", "play"]
            .iter()
            .filter_map(|widget| Some(shell.place(widget)?.center()))
            .chain([pos2(5.0, 5.0)])
            .collect();
        input.events = events(&mut random, points, &places);
        let output = frame::run(&ctx, &mut shell, &mut session, &mut painter.renderer, input, Instant::now()).output;
        if let Some(texture) = shell.take_new_texels(&session) {
            painter.back_buffer.touch(texture);
        }
        let [parts, whole] = painter.paint(&ctx, output, size);
        if parts != whole {
            let first = parts.iter().zip(&whole).position(|(a, b)| a != b).map_or(0, |at| at as u32 / 4);
            panic!(
                "frame {turn}, scale {scale}: ({}, {}) is the first pixel that differs",
                first % size[0],
                first / size[0]
            );
        }
    }
    let [parts, whole] = painter.painted;
    // The picture plays, and a list over everything appears and disappears.
    assert!(parts * 4 < whole * 3, "{parts} of {whole} pixels were painted");
}
