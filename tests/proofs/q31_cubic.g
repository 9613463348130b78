# The tick of Cubic<Q31>, as q31_spline.g. The place x lies from -1/2 to 1/2 and x * p is Q31::step, so that the coefficients are
# those of the polynomial and the slope s is in the units of J.

@floor = fixed<0, dn>;

j3 = floor(jp3 * x);
j2 = jp2 + j3;
j1 = jp1 + floor(j2 * x);
j = jp0 + floor(j1 * x);
s = j1 + floor((j2 + j3) * x);
load = lp0 + floor((lp1 + floor((lp2 + floor(lp3 * x)) * x)) * x);
b = bp0 + floor((bp1 + floor((bp2 + floor(bp3 * x)) * x)) * x);
c = cp0 + floor((cp1 + floor((cp2 + floor(cp3 * x)) * x)) * x);
# The factor of rows is 2k, and Q31::product divides by 2.
speed = floor(k * s * omega) + b;
sum = floor(speed * omega / 2) + floor(j * alpha / 2) - load + c * sign;

J = jp0 + jp1 * x + jp2 * x * x + jp3 * x * x * x;
S = jp1 + 2 * jp2 * x + 3 * jp3 * x * x;
L = lp0 + lp1 * x + lp2 * x * x + lp3 * x * x * x;
B = bp0 + bp1 * x + bp2 * x * x + bp3 * x * x * x;
C = cp0 + cp1 * x + cp2 * x * x + cp3 * x * x * x;
SUM = (k * s * omega + B) * omega / 2 + J * alpha / 2 - L + C * sign;

H3 = jp3 * x;
H2 = jp2 + H3;
H1 = jp1 + H2 * x;

# In units of 2^-31 of the torque base. The whole error is torque + k * omega^2 * slope.
torque = 4 * (sum - SUM);
slope = 2 * (s - S);

{ x in [-0.5, 0.5] /\ omega in [-1, 1] /\ alpha in [-1, 1] /\ sign in [-1, 1]
->
torque in [-24, 23] /\
slope in [-7, 3]
}

J -> jp0 + H1 * x;
S -> H1 + (H2 + H3) * x;
L -> lp0 + (lp1 + (lp2 + lp3 * x) * x) * x;
B -> bp0 + (bp1 + (bp2 + bp3 * x) * x) * x;
C -> cp0 + (cp1 + (cp2 + cp3 * x) * x) * x;

# A place left of the middle, and one right of it.
torque $ x in (0);
