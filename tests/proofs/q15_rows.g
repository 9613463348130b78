# The tick of Rows16: Model::torque against the same formulas without a floor, for the words that the table has and the place
# that the tick reads. A word is a line w + d * u whose start w has the fraction of its lower half.
#
# v, b, c and the load are in units of 2^-15 of the torque base, j in units of 2^-16 of the inertia base. bc and cc are the
# constants, or 0. c is taken with its sign, as in q31_spline.g.

@floor = fixed<0, dn>;

v = floor(vw + vd * u);
j = floor(j0 + floor(jw + jd * u) * u);
minus_load = g0 + floor(gw + gd * u) * u;
b = bc + floor(bw + bd * u);
c = cc + floor(cw + cd * u);
# kernel::of_speed: half a unit rounds, whether the set has a b or not.
speed = floor((v * omega + b) * 2 + 0.5);
# kernel::torque. Half a unit for its floor is part of the load as it is stored, or is added.
sum = floor(speed * omega / 2 + j * alpha / 2 + minus_load + c * sign);

# Of the curves as Table::at reads them, each with its floors.
READ = (v * omega + b) * 2 * omega / 2 + j * alpha / 2 + minus_load + c * sign - 0.5;

# Without any floor.
V = vw + vd * u;
J = j0 + jw * u + jd * u * u;
MINUS_LOAD = g0 + gw * u + gd * u * u;
B = bc + (bw + bd * u);
C = cc + (cw + cd * u);
SUM = (V * omega + B) * 2 * omega / 2 + J * alpha / 2 + MINUS_LOAD + C * sign - 0.5;

# In units of 2^-15 of the torque base.
rounding = sum - READ;
torque = sum - SUM;

{ u in [0, 1] /\ omega in [-1, 1] /\ alpha in [-1, 1] /\ sign in [-1, 1]
->
rounding in [-0.75, 0.75] /\
torque in [-5.75, 3.75]
}

J -> j0 + (jw + jd * u) * u;
MINUS_LOAD -> g0 + (gw + gd * u) * u;
speed - (v * omega + b) * 2 -> (speed - ((v * omega + b) * 2 + 0.5)) + 0.5;
sum - READ -> (sum - (speed * omega / 2 + j * alpha / 2 + minus_load + c * sign)) + 0.5
  + (speed - (v * omega + b) * 2) * omega / 2;
speed - (V * omega + B) * 2 -> (speed - ((v * omega + b) * 2 + 0.5)) + 0.5 + ((v - V) * omega + (b - B)) * 2;
sum - SUM -> (sum - (speed * omega / 2 + j * alpha / 2 + minus_load + c * sign)) + 0.5
  + (speed - (V * omega + B) * 2) * omega / 2 + (j - J) * alpha / 2 + (minus_load - MINUS_LOAD) + (c - C) * sign;

# A square is not negative.
torque $ omega in (0);
