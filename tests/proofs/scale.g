# The factor of the velocity torque, 1/2 * cells/span * J_b * w_b^2 / T_b: of bases rounded to single precision over that of the
# bases before, of which Scale::for_cells makes a whole number; and as a model in f32 computes it (velocity_factor) over that of
# its own bases and its own span. Bases from 1e-6 to 1e6: no product is near the ends of single precision.

@single = float<ieee_32, ne>;

T = single(torque);
W = single(speed);
J = single(inertia);
whole = ((J / inertia) * (W / speed) * (W / speed) / (T / torque) - 1) * 1b24;

base = single(single(single(inertia * speed) / torque) * speed);
BASE = inertia * speed / torque * speed;
factor = single(single(half_cells / span) * base);
FACTOR = half_cells / span * BASE;

# In units of 2^-24; the second one as a share.
{ torque in [1b-20, 1b20] /\ speed in [1b-20, 1b20] /\ inertia in [1b-20, 1b20] /\
  half_cells in [2, 1b15] /\ span in [1b-20, 1b20]
->
whole in [-4.001, 4.001] /\
factor -/ FACTOR in [-2.981e-7, 2.981e-7]
}

J / inertia -> 1 + (J - inertia) / inertia;
W / speed -> 1 + (W - speed) / speed;
T / torque -> 1 + (T - torque) / torque;
