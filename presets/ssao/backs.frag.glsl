// The depth, as the camera sees it, of the nearest back: below zero, and 0 where there is none.

in vec3 vView;
layout(location = 0) out float depth;

void main() {
    depth = vView.z;
}
