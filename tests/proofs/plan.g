# A row of a plan, as Plan::at evaluates it: the sums of its polynomial against the same without a floor, at the place u that the row reads, and
# the shares that a follower takes of the result.
#
# The coefficients c2 to c5 are whole numbers, and the sums in their units; 2 * floor(x * u / 2) is `times`. No number wraps: the row was checked for that
# when the plan was read. f is the factor, at most 1, from units of coefficients to those of accelerations; r the rate, s a speed, y an acceleration.

@floor = fixed<0, dn>;

w5 = 2 * floor(c5 * u / 2);
w4 = 2 * floor((c4 + w5) * u / 2);
w3 = 2 * floor((c3 + w4) * u / 2);
w2 = 2 * floor((c2 + w3) * u / 2);
way = 2 * floor(w2 * u / 2);

v5 = 2 * floor(5 * c5 * u / 2);
v4 = 2 * floor((4 * c4 + v5) * u / 2);
v3 = 2 * floor((3 * c3 + v4) * u / 2);
gained = 2 * floor((2 * c2 + v3) * u / 2);

a5 = 2 * floor(20 * c5 * u / 2);
a4 = 2 * floor((12 * c4 + a5) * u / 2);
a3 = 2 * floor((6 * c3 + a4) * u / 2);
raised = floor((2 * c2 + a3) * f);

# The same exactly.
WAY = c2 * u * u + c3 * u * u * u + c4 * u * u * u * u + c5 * u * u * u * u * u;
GAINED = 2 * c2 * u + 3 * c3 * u * u + 4 * c4 * u * u * u + 5 * c5 * u * u * u * u;
RAISED = (2 * c2 + 6 * c3 * u + 12 * c4 * u * u + 20 * c5 * u * u * u) * f;

# Horner's scheme, as `times` rounds it.
W5 = 2 * (c5 * u / 2);
W4 = 2 * ((c4 + W5) * u / 2);
W3 = 2 * ((c3 + W4) * u / 2);
W2 = 2 * ((c2 + W3) * u / 2);
V5 = 2 * (5 * c5 * u / 2);
V4 = 2 * ((4 * c4 + V5) * u / 2);
V3 = 2 * ((3 * c3 + V4) * u / 2);
A5 = 2 * (20 * c5 * u / 2);
A4 = 2 * ((12 * c4 + A5) * u / 2);
A3 = 2 * ((6 * c3 + A4) * u / 2);

# In units of the coefficients, the acceleration in its own. Shifts to units of positions and of speeds are rounded down once more.
position = way - WAY;
speed = gained - GAINED;
acceleration = raised - RAISED;

# Of a follower, in units of speeds and of accelerations.
share = floor(s * r) - s * r;
twice = floor(floor(y * r) * r) - y * r * r;

{ u in [0, 1] /\ f in [0, 1] /\ r in [0, 1]
->
position in [-10, 0] /\
speed in [-8, 0] /\
acceleration in [-7, 0] /\
share in [-1, 0] /\
twice in [-2, 0]
}

WAY -> 2 * (W2 * u / 2);
GAINED -> 2 * ((2 * c2 + V3) * u / 2);
RAISED -> (2 * c2 + A3) * f;
