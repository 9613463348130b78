# The tick of Spline<f32>, as f32_rows.g: Model::torque against the same formulas in exact numbers. Control points are at most 1/8
# in size, the mean of J and every argument at most 1. Curves have their coefficients from number::spline::cubic.

@r = float<ieee_32, ne>;

jd0 r= jc1 - jc0;
jd1 r= jc2 - jc1;
jd2 r= jc3 - jc2;
js0 r= jd1 - jd0;
js1 r= jd2 - jd1;
jp0 r= jc1 * 6 + js0 + mean;
jp1 r= (jd0 + jd1) * 3;
jp2 r= js0 * 3;
jp3 r= js1 - js0;
ld0 r= lc1 - lc0;
ld1 r= lc2 - lc1;
ld2 r= lc3 - lc2;
ls0 r= ld1 - ld0;
ls1 r= ld2 - ld1;
lp0 r= lc1 * 6 + ls0;
lp1 r= (ld0 + ld1) * 3;
lp2 r= ls0 * 3;
lp3 r= ls1 - ls0;
bd0 r= bc1 - bc0;
bd1 r= bc2 - bc1;
bd2 r= bc3 - bc2;
bs0 r= bd1 - bd0;
bs1 r= bd2 - bd1;
bp0 r= bc1 * 6 + bs0;
bp1 r= (bd0 + bd1) * 3;
bp2 r= bs0 * 3;
bp3 r= bs1 - bs0;
cd0 r= cc1 - cc0;
cd1 r= cc2 - cc1;
cd2 r= cc3 - cc2;
cs0 r= cd1 - cd0;
cs1 r= cd2 - cd1;
cp0 r= cc1 * 6 + cs0;
cp1 r= (cd0 + cd1) * 3;
cp2 r= cs0 * 3;
cp3 r= cs1 - cs0;

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

# The same exactly.
J0 = jc1 * 6 + ((jc2 - jc1) - (jc1 - jc0)) + mean;
J1 = ((jc1 - jc0) + (jc2 - jc1)) * 3;
J2 = ((jc2 - jc1) - (jc1 - jc0)) * 3;
J3 = ((jc3 - jc2) - (jc2 - jc1)) - ((jc2 - jc1) - (jc1 - jc0));
L0 = lc1 * 6 + ((lc2 - lc1) - (lc1 - lc0));
L1 = ((lc1 - lc0) + (lc2 - lc1)) * 3;
L2 = ((lc2 - lc1) - (lc1 - lc0)) * 3;
L3 = ((lc3 - lc2) - (lc2 - lc1)) - ((lc2 - lc1) - (lc1 - lc0));
B0 = bc1 * 6 + ((bc2 - bc1) - (bc1 - bc0));
B1 = ((bc1 - bc0) + (bc2 - bc1)) * 3;
B2 = ((bc2 - bc1) - (bc1 - bc0)) * 3;
B3 = ((bc3 - bc2) - (bc2 - bc1)) - ((bc2 - bc1) - (bc1 - bc0));
C0 = cc1 * 6 + ((cc2 - cc1) - (cc1 - cc0));
C1 = ((cc1 - cc0) + (cc2 - cc1)) * 3;
C2 = ((cc2 - cc1) - (cc1 - cc0)) * 3;
C3 = ((cc3 - cc2) - (cc2 - cc1)) - ((cc2 - cc1) - (cc1 - cc0));
J = J0 + J1 * u + J2 * u * u + J3 * u * u * u;
S = J1 + 2 * J2 * u + 3 * J3 * u * u;
L = L0 + L1 * u + L2 * u * u + L3 * u * u * u;
B = B0 + B1 * u + B2 * u * u + B3 * u * u * u;
C = C0 + C1 * u + C2 * u * u + C3 * u * u * u;
TICK = (S * factor * omega + B) * omega + J * alpha - L + C * sign;

H3 = J3 * u;
H2 = J2 + H3;
H1 = J1 + H2 * u;

# In units of 2^-24.
torque = (tick - TICK) * 1b24;

{ u in [0, 1] /\ omega in [-1, 1] /\ alpha in [-1, 1] /\ sign in [-1, 1] /\ factor in [-1, 1] /\ mean in [-1, 1] /\
  jc0 in [-0.125, 0.125] /\ jc1 in [-0.125, 0.125] /\ jc2 in [-0.125, 0.125] /\ jc3 in [-0.125, 0.125] /\
  lc0 in [-0.125, 0.125] /\ lc1 in [-0.125, 0.125] /\ lc2 in [-0.125, 0.125] /\ lc3 in [-0.125, 0.125] /\
  bc0 in [-0.125, 0.125] /\ bc1 in [-0.125, 0.125] /\ bc2 in [-0.125, 0.125] /\ bc3 in [-0.125, 0.125] /\
  cc0 in [-0.125, 0.125] /\ cc1 in [-0.125, 0.125] /\ cc2 in [-0.125, 0.125] /\ cc3 in [-0.125, 0.125]
->
torque in [-191.5, 191.5]
}

J -> J0 + H1 * u;
S -> H1 + (H2 + H3) * u;
L -> L0 + (L1 + (L2 + L3 * u) * u) * u;
B -> B0 + (B1 + (B2 + B3 * u) * u) * u;
C -> C0 + (C1 + (C2 + C3 * u) * u) * u;
