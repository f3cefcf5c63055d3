//! Pipelines of compiled stages, keyed by everything that determines them.

use super::{
    EngineError,
    cache::{ByAddress, Cache},
    compiled::CompiledProgram,
};
use eddy_glsl::{Attribute, Compiled, interface};
use eddy_gpu::{
    Binding, CounterTargets, FragmentPipelineDescriptor, Gpu, GpuError, MeshPipelineDescriptor, Pipeline, Shader,
    check_targets, constant_buffer,
};
use eddy_media::mesh::Vertex;
use eddy_project::{Cull, DepthTest, MeshDraw};
use eddy_texture::TexelFormat;
use std::{
    collections::HashMap,
    mem::offset_of,
    num::NonZero,
    sync::{
        Arc,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
};

/// The pipeline of one program.
pub(super) struct StagePipeline {
    pub pipeline: Pipeline,
    /// The constant tables of its stages, if any, by their bindings.
    pub tables: Vec<(u32, wgpu::Buffer)>,
}

/// The bindings of the uniform group and of the channel group.
pub(super) type Groups = [Vec<(u32, Binding)>; 2];

/// The description of a pipeline, which is also its key.
pub(super) struct PipelineOrder {
    /// The pipeline's name in messages; it is not part of the pipeline's identity.
    pub label: String,
    pub program: CompiledProgram,
    pub groups: Groups,
    pub formats: Vec<TexelFormat>,
    pub mesh: Option<MeshState>,
}

/// The render state for the triangles of a mesh.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct MeshState {
    cull: Cull,
    depth: DepthTest,
    depth_write: bool,
    color_write: bool,
}

impl MeshState {
    pub(crate) fn of(draw: &MeshDraw) -> Self {
        let &MeshDraw { cull, depth, depth_write, color_write, .. } = draw;
        Self { cull, depth, depth_write, color_write }
    }
}

#[derive(Clone, PartialEq, Eq, Hash)]
struct PipelineKey {
    vertex: Option<ByAddress<Compiled>>,
    fragment: ByAddress<Compiled>,
    groups: Groups,
    formats: Vec<TexelFormat>,
    mesh: Option<MeshState>,
}

/// The pipelines of this build and earlier ones.
#[derive(Default)]
pub(super) struct PipelineCache {
    made: Cache<PipelineKey, Arc<StagePipeline>>,
    /// The number of pipelines that the current build has created.
    built: usize,
}

impl PipelineCache {
    /// Returns a pipeline for each order. Missing ones are created in parallel: a driver takes a tenth of a second for
    /// one.
    pub(crate) fn make(
        &mut self,
        gpu: &Gpu,
        orders: Vec<PipelineOrder>,
    ) -> Result<Vec<Arc<StagePipeline>>, EngineError> {
        let keys: Vec<PipelineKey> = orders.iter().map(PipelineOrder::key).collect();
        let mut missing: HashMap<&PipelineKey, PipelineOrder> = HashMap::new();
        let mut in_order = Vec::new();
        for (key, order) in keys.iter().zip(orders) {
            if self.made.get(key).is_none() && !missing.contains_key(key) {
                in_order.push(key);
                missing.insert(key, order);
            }
        }
        let todo: Vec<PipelineOrder> = in_order.iter().filter_map(|key| missing.remove(*key)).collect();
        self.built += todo.len();
        for (key, made) in in_order.into_iter().zip(side_by_side(&todo, |order| order.make(gpu))) {
            self.made.insert(key.clone(), Arc::new(made?));
        }
        Ok(keys.iter().filter_map(|key| self.made.get(key).cloned()).collect())
    }

    /// Returns the orders whose pipelines are missing.
    pub(crate) fn missing<'a>(&self, orders: &'a [PipelineOrder]) -> Vec<&'a PipelineOrder> {
        orders.iter().filter(|order| !self.made.contains(&order.key())).collect()
    }

    /// Ends a build; see [`Cache::end_build`]. Returns the number of pipelines that it created.
    pub(crate) fn end_build(&mut self, is_whole: bool) -> usize {
        self.made.end_build(is_whole);
        std::mem::take(&mut self.built)
    }
}

/// Runs jobs in parallel on as many threads as the machine has cores. The results are in job order.
fn side_by_side<J: Sync, T: Send>(jobs: &[J], work: impl Fn(&J) -> T + Sync) -> Vec<T> {
    let threads = thread::available_parallelism().map_or(1, NonZero::get).min(jobs.len());
    if threads <= 1 {
        return jobs.iter().map(work).collect();
    }
    let next = AtomicUsize::new(0);
    let take = || {
        let mut done = Vec::new();
        while let Some((index, job)) = Some(next.fetch_add(1, Ordering::Relaxed)).and_then(|i| Some((i, jobs.get(i)?)))
        {
            done.push((index, work(job)));
        }
        done
    };
    let mut done: Vec<(usize, T)> = thread::scope(|scope| {
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(take)).collect();
        threads.into_iter().flat_map(|t| t.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))).collect()
    });
    done.sort_unstable_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, result)| result).collect()
}

impl PipelineOrder {
    fn key(&self) -> PipelineKey {
        PipelineKey {
            vertex: self.program.vertex.as_ref().map(ByAddress::of),
            fragment: ByAddress::of(&self.program.fragment),
            groups: self.groups.clone(),
            formats: self.formats.clone(),
            mesh: self.mesh,
        }
    }

    /// Returns the format of each target, and whether the fragment stage writes it.
    fn targets(&self, gpu: &Gpu) -> Result<Vec<(wgpu::TextureFormat, bool)>, GpuError> {
        let formats: Vec<_> = self.formats.iter().map(|format| eddy_gpu::texture_format(*format)).collect();
        check_targets(gpu, &self.label, &formats)?;
        Ok(formats.into_iter().zip(self.program.fragment.reflection.outputs).collect())
    }

    /// Creates the pipelines of counting variants, each with its number of targets; see [`CounterTargets`].
    pub(crate) fn make_counting(gpu: &Gpu, orders: &[(Self, usize)]) -> Result<Vec<StagePipeline>, GpuError> {
        let make = |(order, targets): &(Self, usize)| {
            let targets = CounterTargets::formats(*targets);
            Ok(StagePipeline { pipeline: order.screen_pipeline(gpu, &targets)?, tables: order.tables(gpu)? })
        };
        side_by_side(orders, make).into_iter().collect()
    }

    fn tables(&self, gpu: &Gpu) -> Result<Vec<(u32, wgpu::Buffer)>, GpuError> {
        let table = |(number, bytes): (u32, &[u8])| {
            let is_storage = number == interface::TABLE_BINDING;
            let usage = if is_storage { wgpu::BufferUsages::STORAGE } else { wgpu::BufferUsages::UNIFORM };
            Ok((number, constant_buffer(gpu, "constant tables", usage, bytes)?))
        };
        self.program.tables().map(table).collect()
    }

    fn make(&self, gpu: &Gpu) -> Result<StagePipeline, GpuError> {
        let pipeline = match (&self.program.vertex, &self.mesh) {
            (Some(vertex), Some(mesh)) => self.mesh_pipeline(gpu, vertex, mesh)?,
            _ => self.screen_pipeline(gpu, &self.targets(gpu)?)?,
        };
        Ok(StagePipeline { pipeline, tables: self.tables(gpu)? })
    }

    fn screen_pipeline(&self, gpu: &Gpu, targets: &[(wgpu::TextureFormat, bool)]) -> Result<Pipeline, GpuError> {
        let descriptor = FragmentPipelineDescriptor {
            label: &self.label,
            shader: shader(&self.program.fragment),
            entry_point: interface::ENTRY_POINT,
            groups: &self.groups,
            targets,
        };
        Pipeline::new(gpu, descriptor)
    }

    fn mesh_pipeline(&self, gpu: &Gpu, vertex: &Compiled, mesh: &MeshState) -> Result<Pipeline, GpuError> {
        let attributes: Vec<(u32, u8, u64)> = vertex.reflection.attributes.iter().map(|a| attribute(*a)).collect();
        let mut targets = self.targets(gpu)?;
        targets.iter_mut().for_each(|(_, is_written)| *is_written &= mesh.color_write);
        let descriptor = MeshPipelineDescriptor {
            label: &self.label,
            vertex: shader(vertex),
            fragment: shader(&self.program.fragment),
            entry_point: interface::ENTRY_POINT,
            groups: &self.groups,
            stride: size_of::<Vertex>() as u64,
            attributes: &attributes,
            targets: &targets,
            cull: cull_mode(mesh.cull),
            depth: compare_function(mesh.depth),
            depth_write: mesh.depth_write,
        };
        Pipeline::for_meshes(gpu, descriptor)
    }
}

fn shader(stage: &Compiled) -> Shader<'_> {
    Shader { module: &stage.module, initialized_arrays: stage.initialized_arrays }
}

/// Returns the location, the number of floats and the offset of an attribute in a vertex.
fn attribute(attribute: Attribute) -> (u32, u8, u64) {
    let offset = match attribute {
        Attribute::Position => offset_of!(Vertex, position),
        Attribute::Normal => offset_of!(Vertex, normal),
        Attribute::Tangent => offset_of!(Vertex, tangent),
        Attribute::Uv => offset_of!(Vertex, uv),
        Attribute::Color => offset_of!(Vertex, color),
    };
    (attribute.location(), attribute.components(), offset as u64)
}

fn cull_mode(cull: Cull) -> Option<wgpu::Face> {
    match cull {
        Cull::Back => Some(wgpu::Face::Back),
        Cull::Front => Some(wgpu::Face::Front),
        Cull::None => None,
    }
}

fn compare_function(test: DepthTest) -> wgpu::CompareFunction {
    use wgpu::CompareFunction as C;
    match test {
        DepthTest::Less => C::Less,
        DepthTest::LessEqual => C::LessEqual,
        DepthTest::Equal => C::Equal,
        DepthTest::GreaterEqual => C::GreaterEqual,
        DepthTest::Greater => C::Greater,
        DepthTest::NotEqual => C::NotEqual,
        DepthTest::Always => C::Always,
    }
}
