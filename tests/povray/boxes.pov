// SPDX-License-Identifier: Apache-2.0
// Objects whose surface lies in front of the box that POV-Ray keeps for them, and a wall between
// surface and box: the wall is seen by who trusts the box, the objects by the linear search.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location <0, 0, -10> direction z right 12 * x up 9 * y }
#declare Glow = finish { emission 1 ambient 0 diffuse 0 }

// the wall
box { <-9, -9, 15>, <9, 9, 16> pigment { rgb <0, 0, 1> } finish { Glow } }

// a union that takes the box of its bounding object, far behind it
union {
    sphere { <-4, 0, 0>, 1 }
    sphere { <-4, 2, 0>, 1 }
    bounded_by { box { <-5, -1, 30>, <-3, 3, 30.5> } }
    pigment { rgb <1, 0, 0> }
    finish { Glow }
}

// an intersection that takes the box of a disc, behind which everything is inside
intersection {
    sphere { 0, 2 scale <1, 1, 7> translate 10 * z }
    disc { <0, 0, 20>, z, 5 }
    pigment { rgb <0, 1, 0> }
    finish { Glow }
}

// a plane that takes the box of the inverted sphere that clips it
plane {
    z, 9
    clipped_by { sphere { <0, 0, 40>, 8 inverse } }
    translate <0, 0, 0>
    pigment { rgb <1, 1, 0> }
    finish { Glow }
}
