// SPDX-License-Identifier: Apache-2.0
// mesh and mesh2: flat, smooth, with textures by triangle and by corner, uv, an interior texture.
#include "head.inc"
#include "ball.inc"
camera { location <0, 2, -8> look_at <0, 0, 0> angle 45 }
Light_And_Floor(-1.2)
#declare Checked = texture { pigment { uv_mapping checker rgb <1, 0.8, 0.2>, rgb <0.1, 0.4, 0.1> scale 0.1 } }
#declare Glass = texture { pigment { rgbf <0.9, 0.95, 1, 0.8> } finish { reflection 0.1 specular 0.5 } }
object { Ball("flat", 16, 0) texture { Matter[1] } } translate <-2.2, 1.2, 0> }
object { Ball("smooth", 16, 0) texture { Matter[2] } } translate <0, 1.2, 0> }
object { Ball("textured", 16, 0) } translate <2.2, 1.2, 0> }
object { Ball("flat2", 16, 0) texture { Glass } interior { ior 1.4 } } scale <1, 0.9, 1> translate <-2.2, -0.6, -1> }
object { Ball("smooth2", 16, x) } texture { Glass } interior { ior 1.3 } interior_texture { Matter[3] } scale 0.9 translate <0, -0.6, -1> }
object { Ball("textured2", 16, 0) uv_mapping } texture { Checked } rotate 30 * x scale 0.9 translate <2.2, -0.6, -1> }
