//! A mesh with its transform, and the camera's matrices.

use super::FrameInputs;
use eddy_glsl::interface::GeometryBlock;
use eddy_gpu::MeshBuffers;
use eddy_media::mesh::Mesh;
use eddy_project::{Camera, MeshDraw};
use glam::{Mat3, Mat4, Quat, Vec3, camera::rh};
use std::sync::Arc;

/// A mesh with its transform.
pub(super) struct MeshInstance {
    /// The contents of the buffers, for reading back the inputs of a draw.
    pub mesh: Arc<Mesh>,
    pub buffers: Arc<MeshBuffers>,
    model: Mat4,
}

impl MeshInstance {
    pub(crate) fn new(mesh: Arc<Mesh>, buffers: Arc<MeshBuffers>, draw: &MeshDraw) -> Self {
        Self { mesh, buffers, model: model(draw) }
    }

    /// Returns the uniforms of a mesh for a camera, in a picture of size `own` on a canvas.
    pub(crate) fn block(
        &self,
        camera: &Camera,
        inputs: &FrameInputs,
        own: (u32, u32),
        canvas: (u32, u32),
    ) -> GeometryBlock {
        let (view, position) = view(camera, inputs.drag, canvas);
        let aspect = own.0 as f32 / own.1 as f32;
        let fov = (camera.fov as f32).to_radians();
        let projection = rh::proj::opengl::perspective(fov, aspect, camera.near as f32, camera.far as f32);
        let linear = Mat3::from_mat4(self.model);
        let columns = linear.inverse().transpose().to_cols_array_2d();
        GeometryBlock {
            model: self.model.to_cols_array_2d(),
            view: view.to_cols_array_2d(),
            projection: projection.to_cols_array_2d(),
            normal: columns.map(|[x, y, z]| [x, y, z, 0.0]),
            camera: position.extend(0.0).to_array(),
        }
    }
}

/// Returns the matrix from the world to the camera, and the position of the camera. Dragging across the canvas rotates
/// it by 360 degrees, dragging up it by 180 degrees, stopping just short of the poles.
fn view(camera: &Camera, drag: [f32; 2], canvas: (u32, u32)) -> (Mat4, Vec3) {
    let [x, y] = if camera.orbit { drag } else { [0.0; 2] };
    let yaw = (camera.yaw as f32 - 360.0 * x / canvas.0 as f32).to_radians();
    let pitch = (camera.pitch as f32 - 180.0 * y / canvas.1 as f32).clamp(-89.0, 89.0).to_radians();
    let out = Vec3::new(pitch.cos() * yaw.sin(), pitch.sin(), pitch.cos() * yaw.cos());
    let target = vec3(camera.target);
    let position = target + camera.distance as f32 * out;
    (rh::view::look_at_mat4(position, target, Vec3::Y), position)
}

fn vec3(v: [f64; 3]) -> Vec3 {
    Vec3::from(v.map(|x| x as f32))
}

fn model(draw: &MeshDraw) -> Mat4 {
    let [x, y, z] = draw.rotation.map(|degrees| (degrees as f32).to_radians());
    let turn = Quat::from_rotation_z(z) * Quat::from_rotation_y(y) * Quat::from_rotation_x(x);
    Mat4::from_scale_rotation_translation(Vec3::splat(draw.scale as f32), turn, vec3(draw.position))
}

#[cfg(test)]
mod tests {
    use super::*;
    use eddy_project::{Cull, DepthTest, MeshSource};

    #[test]
    fn dragging_rotates_the_camera_about_its_target() {
        let camera = Camera { yaw: 90.0, pitch: 0.0, distance: 3.0, target: [1.0, 2.0, 0.0], ..Camera::default() };
        let at = |drag| view(&camera, drag, (200, 100)).1;
        let near = |a: Vec3, b: Vec3| assert!(a.distance(b) < 1e-5, "{a} is not {b}");
        near(at([0.0, 0.0]), Vec3::new(4.0, 2.0, 0.0));
        // The scene follows the pointer: the camera moves the other way, by 90 degrees for a quarter of the width.
        near(at([50.0, 0.0]), Vec3::new(1.0, 2.0, 3.0));
        near(at([-50.0, 0.0]), Vec3::new(1.0, 2.0, -3.0));
        assert!(at([0.0, -25.0]).y > 2.0 && at([0.0, 1e6]).y > -1.0);
        let fixed = Camera { orbit: false, ..camera };
        near(view(&fixed, [50.0, 50.0], (200, 100)).1, Vec3::new(4.0, 2.0, 0.0));
    }

    #[test]
    fn meshes_are_scaled_rotated_and_translated_in_this_order() {
        let draw = MeshDraw {
            mesh: MeshSource::Builtin("cube".into()),
            normals: None,
            vertex: eddy_project::Stage::Own,
            fragment: eddy_project::Stage::Own,
            cull: Cull::Back,
            depth: DepthTest::Less,
            depth_write: true,
            color_write: true,
            scale: 2.0,
            rotation: [90.0, 90.0, 0.0],
            position: [0.0, 0.0, 10.0],
        };
        // Rotation about x takes y to z, and about y takes z to x.
        let there = model(&draw).transform_point3(Vec3::Y);
        assert!(there.distance(Vec3::new(2.0, 0.0, 10.0)) < 1e-5, "{there}");
    }
}
