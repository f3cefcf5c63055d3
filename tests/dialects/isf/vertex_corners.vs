// A vertex shader runs at the four corners: what is limited there is interpolated between them.
varying vec2 moved;
varying float corner_level;

void main() {
    isf_vertShaderInit();
    moved = clamp(isf_FragNormCoord - shift, 0.0, 1.0);
    corner_level = isf_FragNormCoord.x < 0.5 ? 0.25 : 0.75;
}
