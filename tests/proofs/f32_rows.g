# The tick of Cubic<f32>, and of Quadratic<f32>, whose p3 is 0 (then both compute the same): Model::torque against the same
# formulas in exact numbers, for the words that the table has and the place that the tick reads.
#
# Every coefficient and every argument is at most 1 in size. That is all tables: multiplied by a power of two, a curve or an
# argument rounds as before (unless a product falls below 2^-126).
# `x r= ...` rounds every operation on its right. c is taken with its sign, as in q31_spline.g; its product with the sign of
# omega is exact.

@r = float<ieee_32, ne>;

j3 r= jp3 * u;
j2 r= jp2 + j3;
j1 r= jp1 + j2 * u;
j r= jp0 + j1 * u;
s r= j1 + (j2 + j3) * u;
load r= lp0 + (lp1 + (lp2 + lp3 * u) * u) * u;
b r= bp0 + (bp1 + (bp2 + bp3 * u) * u) * u;
c r= cp0 + (cp1 + (cp2 + cp3 * u) * u) * u;
sum r= (s * factor * omega + b) * omega + j * alpha - load;
tick = r(sum + c * sign);

J = jp0 + jp1 * u + jp2 * u * u + jp3 * u * u * u;
S = jp1 + 2 * jp2 * u + 3 * jp3 * u * u;
L = lp0 + lp1 * u + lp2 * u * u + lp3 * u * u * u;
B = bp0 + bp1 * u + bp2 * u * u + bp3 * u * u * u;
C = cp0 + cp1 * u + cp2 * u * u + cp3 * u * u * u;
TICK = (S * factor * omega + B) * omega + J * alpha - L + C * sign;

H3 = jp3 * u;
H2 = jp2 + H3;
H1 = jp1 + H2 * u;

# In units of 2^-24.
torque = (tick - TICK) * 1b24;

{ u in [0, 1] /\ omega in [-1, 1] /\ alpha in [-1, 1] /\ sign in [-1, 1] /\ factor in [-1, 1] /\
  jp0 in [-1, 1] /\ jp1 in [-1, 1] /\ jp2 in [-1, 1] /\ jp3 in [-1, 1] /\
  lp0 in [-1, 1] /\ lp1 in [-1, 1] /\ lp2 in [-1, 1] /\ lp3 in [-1, 1] /\
  bp0 in [-1, 1] /\ bp1 in [-1, 1] /\ bp2 in [-1, 1] /\ bp3 in [-1, 1] /\
  cp0 in [-1, 1] /\ cp1 in [-1, 1] /\ cp2 in [-1, 1] /\ cp3 in [-1, 1]
->
torque in [-114.5, 114.5]
}

J -> jp0 + H1 * u;
S -> H1 + (H2 + H3) * u;
L -> lp0 + (lp1 + (lp2 + lp3 * u) * u) * u;
B -> bp0 + (bp1 + (bp2 + bp3 * u) * u) * u;
C -> cp0 + (cp1 + (cp2 + cp3 * u) * u) * u;
