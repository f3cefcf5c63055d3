// Which parts of a mesh are cut out, line and all.

#iUniform int clipping = 0 in { 0, 2 }          // 0 nothing, 1 by the clipping mask, 2 by the base map's alpha
#iUniform float clipLevel = 0.5 in { 0.0, 1.0 } // what is below it is cut out
#iUniform bool clipInverse = false              // the other part is cut out instead

bool isClipped(vec2 place) {
    if (clipping == 0) return false;
    float value = clipping == 1 ? textureLod(iChannel1, place, 0.0).y : textureLod(iChannel0, place, 0.0).a;
    return (value >= clipLevel) == clipInverse;
}
