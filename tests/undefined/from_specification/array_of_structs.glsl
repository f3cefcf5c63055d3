struct Cell { vec2 fill; float edge; };
void mainImage(out vec4 c, in vec2 f) {
    float k = 0.5;
    Cell cells[3];
    cells[0] = Cell(vec2(k), k);
    cells[1].fill.x = k;
    cells[1].edge = k;
    cells[2] = cells[0];
    int i = f.x < 2.0 ? 1 : 2;
    c = vec4(cells[i].fill.y, cells[1].fill.x, cells[1].edge, 1.0);
}
