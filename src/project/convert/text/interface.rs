//! The values that the program sets, and the outputs of the shader.

use super::{
    super::{
        declarations::{Declarations, Interface, Storage},
        values,
    },
    Writer,
};
use crate::{CustomUniform, CustomUniformType, CustomUniformValues, HostUniform, HostValue, SLOTS};
use std::{collections::HashSet, fmt::Write};

impl<'t> Writer<'_, 't> {
    /// Assigns `iChannel0` and so on to the textures that the text reads.
    pub(super) fn channels(&mut self, found: &Declarations<'t>) -> Result<(), Vec<String>> {
        let used = self.used(found);
        let (prefix, suffix) = self.cx.row.texture_size;
        let is_used = |name: &str| used.contains(name) || used.contains(&*format!("{prefix}{name}{suffix}"));
        let read: Vec<(usize, &str)> = self.pass.bindings.names().filter(|(_, name)| is_used(name)).collect();
        if read.len() > SLOTS {
            return Err(read.iter().map(|(_, name)| (*name).to_owned()).collect());
        }
        for (channel, (slot, name)) in read.into_iter().enumerate() {
            self.renames.name(name, format!("iChannel{channel}"));
            self.dynamic.insert(name.to_owned());
            self.result.slots.push(slot);
            let size = format!("{prefix}{name}{suffix}");
            if used.contains(&*size) {
                let value = format!("vec2(textureSize(iChannel{channel}, 0).xy)");
                self.declare("vec2", &size, Some(value));
            }
        }
        Ok(())
    }

    /// The words of the text outside the declarations of inputs and outputs.
    pub(super) fn used(&self, found: &Declarations<'t>) -> HashSet<&'t str> {
        let is_declared = |at: usize| found.interface.iter().any(|variable| variable.declaration.contains(&at));
        let words = self.tokens.iter().enumerate().filter(|(_, token)| token.is_word());
        words.filter(|(at, _)| !is_declared(*at)).map(|(_, token)| token.text).collect()
    }

    /// Declares a variable before the text.
    pub(super) fn declare(&mut self, ty: &str, name: &str, value: Option<String>) {
        if !self.hoisted.insert(name.to_owned()) {
            return;
        }
        self.renames.uniform(name, &self.cx.free);
        let own = self.renames.new_name(name).to_owned();
        self.dynamic.insert(name.to_owned());
        match value {
            Some(value) => {
                let _ = writeln!(self.before, "{ty} {own};");
                let _ = writeln!(self.inputs, "    {own} = {value};");
            }
            None => {
                let _ = writeln!(self.before, "{ty} {own} = {};", values::zero(ty));
            }
        }
    }

    /// Replaces the declarations of what the program sets, and of the outputs.
    pub(super) fn interface(&mut self, found: &Declarations<'t>) {
        let used = self.used(found);
        let mut sliders = Vec::new();
        let mut left: Vec<(usize, bool)> = Vec::new();
        for variable in &found.interface {
            let is_left = !self.variable(variable, &used, &mut sliders);
            match left.last_mut().filter(|(start, _)| *start == variable.declaration.start) {
                Some((_, known)) => *known |= is_left,
                None => left.push((variable.declaration.start, is_left)),
            }
        }
        for (start, is_left) in left {
            let Some(variable) = found.interface.iter().find(|variable| variable.declaration.start == start) else {
                continue;
            };
            if !is_left {
                self.deleted.push(self.bytes(&variable.declaration));
            } else if variable.storage != Storage::Uniform && variable.qualifiers.start < variable.qualifiers.end {
                self.deleted.push(self.bytes(&variable.qualifiers));
            }
        }
        if !self.cx.row.has_declarations {
            let given = self.cx.row.uniforms.iter();
            let is_used = |name: &str| used.contains(name) || self.cx.common.contains(name);
            for uniform in given.filter(|uniform| is_used(uniform.name)).collect::<Vec<_>>() {
                self.given(uniform);
            }
            self.cx.sliders.iter().for_each(|slider| {
                self.renames.uniform(&slider.name, &self.cx.free);
                self.dynamic.insert(slider.name.clone());
            });
        }
        if !sliders.is_empty() {
            let note = "// Sliders of Eddy. On shadertoy.com each line must be a constant: const float name = 0.5;\n";
            self.before.insert_str(0, &(note.to_owned() + &sliders.concat()));
        }
    }

    /// Replaces the declaration of a variable. Returns whether its own one is no longer needed.
    pub(super) fn variable(
        &mut self,
        variable: &Interface<'t>,
        used: &HashSet<&str>,
        sliders: &mut Vec<String>,
    ) -> bool {
        let Interface { storage, ty, name, is_array, .. } = *variable;
        let row = self.cx.row;
        if storage == Storage::Output {
            if is_array {
                return false;
            }
            if self.hoisted.insert(name.to_owned()) {
                self.renames.uniform(name, &self.cx.free);
                let own = self.renames.new_name(name).to_owned();
                let _ = writeln!(self.before, "{ty} {own} = {};", values::zero(ty));
                let location = variable.location.unwrap_or(self.outputs.len() as u32);
                self.outputs.push((location, ty.to_owned(), own));
                self.dynamic.insert(name.to_owned());
            }
            return true;
        }
        if self.pass.bindings.names().any(|(_, sampler)| sampler == name) && ty.starts_with("sampler") {
            return true;
        }
        if is_array || !values::is_basic(ty) {
            self.dynamic.insert(name.to_owned());
            return false;
        }
        let given = row.uniforms.iter().find(|uniform| uniform.name == name && uniform.ty.glsl_name() == ty);
        if let Some(uniform) = given {
            if used.contains(name) {
                self.given(uniform);
            }
            return true;
        }
        if self.hoisted.contains(name) {
            return true;
        }
        if row.identities.iter().any(|(matrix, size)| *matrix == name && ty == format!("mat{size}")) {
            self.declare(ty, name, Some(format!("{ty}(1.0)")));
            return true;
        }
        let slider = self.cx.sliders.iter().find(|slider| slider.name == name && slider.ty.glsl_name() == ty);
        if let Some(slider) = slider.filter(|_| storage == Storage::Uniform) {
            self.hoisted.insert(name.to_owned());
            self.dynamic.insert(name.to_owned());
            self.renames.uniform(name, &self.cx.free);
            let own = self.renames.new_name(name);
            sliders.push(slider_line(slider, own, &self.cx.project.custom_uniform_values));
            return true;
        }
        let has_value = self.cx.project.custom_uniform_values.contains_key(name);
        if has_value && storage == Storage::Uniform {
            self.dynamic.insert(name.to_owned());
            return false;
        }
        if used.contains(name) {
            self.declare(ty, name, None);
        }
        true
    }

    /// Declares a uniform that the program sets.
    pub(super) fn given(&mut self, uniform: &'static HostUniform) {
        self.result.reads_pointer |= matches!(uniform.value, HostValue::Mouse(..));
        if uniform.name == "iGlobalTime" {
            self.renames.name(uniform.name, "iTime");
        } else if values::same_as(uniform) == Some(uniform.name) {
            self.renames.name(uniform.name, uniform.name);
        } else {
            self.declare(uniform.ty.glsl_name(), uniform.name, Some(values::expression(uniform)));
            return;
        }
        self.dynamic.insert(uniform.name.to_owned());
    }

    /// Returns the colour of the pixel as an expression, and declares the outputs of the language.
    pub(super) fn colour(&mut self, found: &Declarations<'t>) -> String {
        let used = self.used(found);
        let mut own = |name: &str, ours: &str, size: &str| {
            if !used.contains(name) {
                return None;
            }
            let ours = self.cx.free.of(ours);
            let value = if size.is_empty() { " = vec4(0.0)" } else { "" };
            let _ = writeln!(self.before, "vec4 {ours}{size}{value};");
            self.renames.name(name, ours.clone());
            self.dynamic.insert(name.to_owned());
            Some(ours)
        };
        let colour = own("gl_FragColor", "pixelColor", "");
        let data = own("gl_FragData", "pixelData", "[8]").map(|data| format!("{data}[0]"));
        let declared = self.outputs.iter().find(|(location, ..)| *location == 0);
        let declared = declared.map(|(_, ty, name)| match ty.as_str() {
            "float" => format!("vec4({name}, 0.0, 0.0, 1.0)"),
            "vec2" => format!("vec4({name}, 0.0, 1.0)"),
            "vec3" => format!("vec4({name}, 1.0)"),
            _ => name.clone(),
        });
        for name in ["gl_Position", "gl_PointSize"] {
            if used.contains(name) {
                self.renames.name(name, self.cx.free.of(name.trim_start_matches("gl_")));
            }
        }
        declared.or(colour).or(data).unwrap_or_else(|| "vec4(0.0)".to_owned())
    }
}

/// Returns the `#iUniform` line of a slider, with its present value as the default.
fn slider_line(slider: &CustomUniform, name: &str, values: &CustomUniformValues) -> String {
    let ty = slider.ty.glsl_name();
    let value = slider.value(values);
    let about = if slider.about.is_empty() { String::new() } else { format!(" // {}", slider.about) };
    let range = slider.range.filter(|_| !matches!(slider.ty, CustomUniformType::Bool)).map_or(String::new(), |range| {
        let whole = |x: f64| if slider.ty == CustomUniformType::Int { format!("{x}") } else { format!("{x:?}") };
        format!(" in {{ {}, {} }}", whole(range.min[0]), whole(range.max[0]))
    });
    format!("#iUniform {ty} {name} = {}{range}{about}\n", value.glsl(slider.ty))
}
