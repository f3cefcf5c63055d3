//! Draws a shader: `cargo run -p eddy-glsl --example draw -- FILE OUT.png`.
//!
//! A text with a `mainImage` is Shadertoy's, any other a plain fragment shader, whose first input is a `vec2` from 0 to
//! 1, and whose uniforms `u_time` and `u_resolution` are set. Every 2D texture is one checkerboard.

use eddy_glsl::{PassSource, SourceMap, compile, interface::UniformBlock, render_all};
use wgpu::{BufferUsages, TextureUsages, util::DeviceExt};

const SIZE: [u32; 2] = [640, 360];
/// Row 0 is the bottom of the picture, as in OpenGL.
const TRIANGLE: &str = "struct V { @builtin(position) at: vec4f, @location(0) uv: vec2f }
@vertex fn main(@builtin(vertex_index) i: u32) -> V {
    let uv = vec2f(f32(i & 1u), f32(i >> 1u)) * 2.0;
    return V(vec4f(uv.x * 2.0 - 1.0, 1.0 - uv.y * 2.0, 0.0, 1.0), uv);
}";

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [path, out] = &arguments[..] else { panic!("usage: draw FILE OUT.png") };
    let text = std::fs::read_to_string(path).expect("a shader");
    let is_image = text.contains("mainImage");
    let source = if is_image { PassSource::image(&text) } else { PassSource::fragment(&text) };
    let mut sources = SourceMap::default();
    sources.add(path, text.as_str());
    let compiled = compile(&source).unwrap_or_else(|found| panic!("\n{}", render_all(&found, &sources)));
    let reflection = &compiled.reflection;

    // Bytes by group and binding, then textures and samplers.
    let (mut buffers, mut textures) = (Vec::new(), Vec::new());
    let resolution = SIZE.map(|pixels| pixels as f32);
    if is_image && !reflection.uniforms.is_empty() {
        let resolution = [resolution[0], resolution[1], 1.0];
        let block = UniformBlock { resolution, time: 1.0, ..bytemuck::Zeroable::zeroed() };
        buffers.push((0, 0, bytemuck::bytes_of(&block).to_vec()));
    }
    let tables = [(0, 1, compiled.tables.clone()), (0, 3, compiled.uniform_tables.clone())];
    buffers.extend(tables.into_iter().filter(|(.., bytes)| !bytes.is_empty()));
    for block in &reflection.shader.buffers {
        let mut bytes = vec![0; block.size as usize];
        for member in &block.members {
            let value = match member.name.as_str() {
                "u_time" => &[1.0][..],
                "u_resolution" => &resolution,
                _ => continue,
            };
            bytes[member.offset as usize..][..4 * value.len()].copy_from_slice(bytemuck::cast_slice(value));
        }
        buffers.push((block.group, block.binding, bytes));
    }
    textures.extend((0..4).zip(reflection.channels).map(|(i, used)| (1, 2 * i, 2 * i + 1, used)));
    textures.extend(reflection.shader.textures.iter().map(|t| (t.group, t.texture_binding, t.sampler_binding, t.used)));

    let adapter = pollster::block_on(wgpu::Instance::default().request_adapter(&Default::default())).expect("a GPU");
    let (device, queue) = pollster::block_on(adapter.request_device(&Default::default())).expect("a device");
    let texture = |[width, height]: [u32; 2], usage| wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8Unorm,
        usage,
        view_formats: &[],
    };
    let checks: Vec<u8> = (0..64).flat_map(|i| [[30, 60, 120, 255], [250, 240, 200, 255]][(i + i / 8) % 2]).collect();
    let of_checks = texture([8, 8], TextureUsages::TEXTURE_BINDING);
    let checks = device.create_texture_with_data(&queue, &of_checks, Default::default(), &checks);
    let (checks, sampler) = (checks.create_view(&Default::default()), device.create_sampler(&Default::default()));
    let module = |source| device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let vertex = module(wgpu::ShaderSource::Wgsl(TRIANGLE.into()));
    let fragment = module(wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(compiled.module.clone())));
    let (entry_point, compilation_options) = (None, wgpu::PipelineCompilationOptions::default());
    let targets = &[Some(wgpu::TextureFormat::Rgba8Unorm.into())];
    let options = compilation_options.clone();
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState { module: &vertex, entry_point, compilation_options: options, buffers: &[] },
        fragment: Some(wgpu::FragmentState { module: &fragment, entry_point, compilation_options, targets }),
        primitive: Default::default(),
        depth_stencil: None,
        multisample: Default::default(),
        multiview_mask: None,
        cache: None,
    });
    let usage = BufferUsages::UNIFORM | BufferUsages::STORAGE;
    let buffer =
        |contents| device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage });
    let buffers: Vec<_> = buffers.iter().map(|(group, binding, bytes)| (*group, *binding, buffer(bytes))).collect();
    let target = device.create_texture(&texture(SIZE, TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC));
    let view = target.create_view(&Default::default());
    let mut encoder = device.create_command_encoder(&Default::default());
    let color = wgpu::RenderPassColorAttachment {
        view: &view,
        depth_slice: None,
        resolve_target: None,
        ops: Default::default(),
    };
    let descriptor = wgpu::RenderPassDescriptor { color_attachments: &[Some(color)], ..Default::default() };
    let mut pass = encoder.begin_render_pass(&descriptor);
    pass.set_pipeline(&pipeline);
    for group in 0..2 {
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let of_buffers = buffers.iter().filter(|(at, ..)| *at == group);
        let of_buffers = of_buffers.map(|(_, binding, buffer)| entry(*binding, buffer.as_entire_binding()));
        let here = || textures.iter().filter(|(at, ..)| *at == group);
        let of_textures = here().filter(|(.., used)| used.texture);
        let of_textures =
            of_textures.map(|(_, binding, ..)| entry(*binding, wgpu::BindingResource::TextureView(&checks)));
        let of_samplers = here().filter(|(.., used)| used.sampler);
        let of_samplers =
            of_samplers.map(|(_, _, binding, _)| entry(*binding, wgpu::BindingResource::Sampler(&sampler)));
        let entries: Vec<_> = of_buffers.chain(of_textures).chain(of_samplers).collect();
        if !entries.is_empty() {
            let layout = &pipeline.get_bind_group_layout(group);
            let made = wgpu::BindGroupDescriptor { label: None, layout, entries: &entries };
            pass.set_bind_group(group, &device.create_bind_group(&made), &[]);
        }
    }
    pass.draw(0..3, 0..1);
    drop(pass);
    let (size, row) = (target.size(), 4 * SIZE[0]);
    let usage = BufferUsages::COPY_DST | BufferUsages::MAP_READ;
    let mapped_at_creation = false;
    let read = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(row * SIZE[1]),
        usage,
        mapped_at_creation,
    });
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
    encoder.copy_texture_to_buffer(target.as_image_copy(), wgpu::TexelCopyBufferInfo { buffer: &read, layout }, size);
    queue.submit([encoder.finish()]);
    read.slice(..).map_async(wgpu::MapMode::Read, |result| result.expect("the picture"));
    device.poll(wgpu::PollType::wait_indefinitely()).expect("the device draws");
    let pixels = read.slice(..).get_mapped_range().expect("mapped").to_vec();
    let picture = image::RgbaImage::from_raw(SIZE[0], SIZE[1], pixels).expect("as many bytes as pixels need");
    image::imageops::flip_vertical(&picture).save(out).expect("a file to write");
}
