varying vec2 right;
varying vec2 above;
varying float level;

void main() {
    isf_vertShaderInit();
    right = isf_FragNormCoord + vec2(shift, 0.0);
    above = isf_FragNormCoord + vec2(0.0, 2.0 / RENDERSIZE.y);
    level = 0.25 + 0.5 * isf_FragNormCoord.x + TIME;
}
