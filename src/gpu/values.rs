//! Conversion of float values to 8 bits for a window, for any range of values.

use super::{Gpu, Texture, full_screen::PictureShader};

/// The mapping of numbers to colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Paint {
    /// Shades from black, the start of the range, to white, its end.
    #[default]
    Range,
    /// Red above zero, blue below, brighter with the distance.
    Sign,
    /// Colours from dark blue through green and yellow to red.
    FalseColour,
}

/// The part of a value that is shown, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ValueLook {
    pub low: f32,
    pub high: f32,
    pub paint: Paint,
    /// A single component; `None` for all.
    pub channel: Option<u8>,
    /// The number of components in use, 1 to 4.
    pub components: u8,
    /// Four NaN mark a pixel that never had the value, as a probe leaves them, rather than a NaN of the author's.
    pub has_gaps: bool,
}

impl Default for ValueLook {
    fn default() -> Self {
        Self { low: 0.0, high: 1.0, paint: Paint::Range, channel: None, components: 4, has_gaps: false }
    }
}

/// Pixels that never had the value are striped. One NaN is violet, an infinity yellow.
const SHADER: &str = "
struct Look { low: f32, high: f32, paint: u32, channel: u32, components: u32, has_gaps: u32 }
@group(0) @binding(0) var values: texture_2d<f32>;
@group(0) @binding(1) var<uniform> look: Look;

fn false_colour(x: f32) -> vec3<f32> {
    let t = clamp(x, 0.0, 1.0) * 5.0;
    var stops = array(vec3(0.05, 0.03, 0.25), vec3(0.1, 0.3, 0.85), vec3(0.05, 0.75, 0.75), vec3(0.35, 0.85, 0.25),
        vec3(0.98, 0.85, 0.15), vec3(0.8, 0.1, 0.1));
    let i = min(u32(t), 4u);
    return mix(stops[i], stops[i + 1u], t - f32(i));
}

@fragment fn fragment(@builtin(position) position: vec4<f32>) -> @location(0) vec4<f32> {
    let size = vec2<i32>(textureDimensions(values));
    let texel = vec2<i32>(position.xy);
    let value = textureLoad(values, vec2(texel.x, size.y - 1 - texel.y), 0);
    // A comparison with NaN is false, and a driver may think that there are none.
    let bits = bitcast<vec4<u32>>(value) & vec4(0x7fffffffu);
    let is_nan = bits > vec4(0x7f800000u);
    if look.has_gaps != 0u && all(is_nan) {
        let is_dark = ((texel.x + texel.y) / 4) % 2 == 0;
        return vec4(select(vec3(0.16), vec3(0.1), is_dark), 1.0);
    }
    var shown = vec4(0u, 1u, 2u, 3u) < vec4(look.components);
    if look.channel < 4u {
        shown = vec4(0u, 1u, 2u, 3u) == vec4(look.channel);
    }
    if any(shown & is_nan) {
        return vec4(0.8, 0.1, 0.9, 1.0);
    }
    if any(shown & (bits == vec4(0x7f800000u))) {
        return vec4(1.0, 0.9, 0.1, 1.0);
    }
    let span = look.high - look.low;
    let scale = select(1.0 / span, 0.0, span == 0.0);
    let part = (value - look.low) * scale;
    let is_single = look.channel < 4u || look.components == 1u;
    let index = select(0u, look.channel, look.channel < 4u);
    // Of several components, how far they are from zero together.
    let masked = select(vec4(0.0), value, shown);
    let single = select(length(masked), value[index], is_single);
    if look.paint == 1u {
        let most = max(abs(look.low), abs(look.high));
        let strength = select(single / most, 0.0, most == 0.0);
        let shade = sqrt(clamp(abs(strength), 0.0, 1.0));
        return vec4(mix(vec3(0.03), select(vec3(0.25, 0.5, 1.0), vec3(1.0, 0.35, 0.2), single > 0.0), shade), 1.0);
    }
    if look.paint == 2u {
        return vec4(false_colour((single - look.low) * scale), 1.0);
    }
    let grey = vec3(part[index]);
    let colour = select(vec3(0.0), part.rgb, shown.rgb);
    return vec4(clamp(select(colour, grey, is_single), vec3(0.0), vec3(1.0)), 1.0);
}
";

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Draws values into a display texture (rgba8unorm).
pub struct ValuePainter {
    shader: PictureShader,
    pipeline: wgpu::RenderPipeline,
}

impl ValuePainter {
    pub fn new(gpu: &Gpu) -> Self {
        let shader = PictureShader::with_uniform(gpu, "values", SHADER);
        Self { pipeline: shader.pipeline(gpu, FORMAT), shader }
    }

    /// Sets the displayed part and its mapping for all following draws.
    pub fn set(&self, gpu: &Gpu, look: &ValueLook) {
        let paint: u32 = match look.paint {
            Paint::Range => 0,
            Paint::Sign => 1,
            Paint::FalseColour => 2,
        };
        let channel = look.channel.map_or(4, u32::from);
        let (low, high) = (look.low.to_bits(), look.high.to_bits());
        self.shader.set(gpu, [low, high, paint, channel, look.components.into(), look.has_gaps.into(), 0, 0]);
    }

    /// Creates the bind group with which [`ValuePainter::present`] shows one picture repeatedly.
    pub fn bind(&self, gpu: &Gpu, values: &wgpu::TextureView) -> wgpu::BindGroup {
        self.shader.bind(gpu, values)
    }

    /// Draws the values into `display`, which must have the same size.
    pub fn present(&self, gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, values: &wgpu::BindGroup, display: &Texture) {
        let target = display.attachment(gpu.load_op_dont_care());
        self.shader.draw(gpu, encoder, &self.pipeline, values, target);
    }
}
