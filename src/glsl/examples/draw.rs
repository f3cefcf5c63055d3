//! Draws a Shadertoy image shader that reads no channels: `cargo run -p eddy-glsl --example draw -- FILE OUT.png`.

use eddy_glsl::{PassSource, SourceMap, compile, interface::UniformBlock, render_all};
use wgpu::{BufferUsages, TextureUsages, util::DeviceExt};

const SIZE: [u32; 2] = [640, 360];
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// Row 0 is the bottom of the picture, as in OpenGL.
const TRIANGLE: &str = "@vertex fn main(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(f32(i & 1u) * 4.0 - 1.0, 1.0 - f32(i >> 1u) * 4.0, 0.0, 1.0);
}";

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [path, out] = &arguments[..] else { panic!("usage: draw FILE OUT.png") };
    let text = std::fs::read_to_string(path).expect("a shader");
    let mut sources = SourceMap::default();
    sources.add(path, text.as_str());
    let compiled =
        compile(&PassSource::image(&text)).unwrap_or_else(|found| panic!("\n{}", render_all(&found, &sources)));
    assert!(compiled.reflection.channels.iter().all(|used| !used.is_read()), "this example binds no textures");

    // What the shader reads, by its binding in group 0.
    let resolution = [SIZE[0] as f32, SIZE[1] as f32, 1.0];
    let uniforms = UniformBlock { resolution, time: 1.0, ..bytemuck::Zeroable::zeroed() };
    let uniforms = if compiled.reflection.uniforms.is_empty() { &[] } else { bytemuck::bytes_of(&uniforms) };
    let read = [(0, uniforms), (1, &compiled.tables[..]), (3, &compiled.uniform_tables[..])];

    let adapter = pollster::block_on(wgpu::Instance::default().request_adapter(&Default::default())).expect("a GPU");
    let (device, queue) = pollster::block_on(adapter.request_device(&Default::default())).expect("a device");
    let module = |source| device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let vertex = module(wgpu::ShaderSource::Wgsl(TRIANGLE.into()));
    let fragment = module(wgpu::ShaderSource::Naga(std::borrow::Cow::Owned(compiled.module.clone())));
    let options = wgpu::PipelineCompilationOptions::default();
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState {
            module: &vertex,
            entry_point: None,
            compilation_options: options.clone(),
            buffers: &[],
        },
        fragment: Some(wgpu::FragmentState {
            module: &fragment,
            entry_point: None,
            compilation_options: options,
            targets: &[Some(FORMAT.into())],
        }),
        primitive: Default::default(),
        depth_stencil: None,
        multisample: Default::default(),
        multiview_mask: None,
        cache: None,
    });
    let target = device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: SIZE[0], height: SIZE[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let usage = BufferUsages::UNIFORM | BufferUsages::STORAGE;
    let buffer =
        |contents| device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage });
    let read = read.into_iter().filter(|(_, bytes)| !bytes.is_empty());
    let read: Vec<_> = read.map(|(at, bytes)| (at, buffer(bytes))).collect();
    let entries: Vec<_> =
        read.iter().map(|(at, b)| wgpu::BindGroupEntry { binding: *at, resource: b.as_entire_binding() }).collect();
    let view = target.create_view(&Default::default());
    let (ops, depth_slice, resolve_target) = (Default::default(), None, None);
    let color = wgpu::RenderPassColorAttachment { view: &view, depth_slice, resolve_target, ops };
    let descriptor = wgpu::RenderPassDescriptor { color_attachments: &[Some(color)], ..Default::default() };
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_render_pass(&descriptor);
    pass.set_pipeline(&pipeline);
    if !entries.is_empty() {
        let layout = &pipeline.get_bind_group_layout(0);
        let group = wgpu::BindGroupDescriptor { label: None, layout, entries: &entries };
        pass.set_bind_group(0, &device.create_bind_group(&group), &[]);
    }
    pass.draw(0..3, 0..1);
    drop(pass);
    let (size, usage) = (u64::from(4 * SIZE[0] * SIZE[1]), BufferUsages::COPY_DST | BufferUsages::MAP_READ);
    let back = wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false };
    let back = device.create_buffer(&back);
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * SIZE[0]), rows_per_image: None };
    let into = wgpu::TexelCopyBufferInfo { buffer: &back, layout };
    encoder.copy_texture_to_buffer(target.as_image_copy(), into, target.size());
    queue.submit([encoder.finish()]);
    back.slice(..).map_async(wgpu::MapMode::Read, |result| result.expect("the picture"));
    device.poll(wgpu::PollType::wait_indefinitely()).expect("the device draws");
    let pixels = back.slice(..).get_mapped_range().expect("mapped").to_vec();
    let picture = image::RgbaImage::from_raw(SIZE[0], SIZE[1], pixels).expect("as many bytes as pixels need");
    image::imageops::flip_vertical(&picture).save(out).expect("a file to write");
}
