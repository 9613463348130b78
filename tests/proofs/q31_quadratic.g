# The tick of Quadratic<Q31>, as q31_cubic.g, with Quadratic's own value and slope.

@floor = fixed<0, dn>;

t = floor(jp2 * x);
q = jp1 + t;
j = jp0 + floor(q * x);
s = q + t;
load = lp0 + floor((lp1 + floor(lp2 * x)) * x);
b = bp0 + floor((bp1 + floor(bp2 * x)) * x);
c = cp0 + floor((cp1 + floor(cp2 * x)) * x);
speed = floor(k * s * omega) + b;
sum = floor(speed * omega / 2) + floor(j * alpha / 2) - load + c * sign;

J = jp0 + jp1 * x + jp2 * x * x;
S = jp1 + 2 * jp2 * x;
L = lp0 + lp1 * x + lp2 * x * x;
B = bp0 + bp1 * x + bp2 * x * x;
C = cp0 + cp1 * x + cp2 * x * x;
SUM = (k * s * omega + B) * omega / 2 + J * alpha / 2 - L + C * sign;

# In units of 2^-31 of the torque base. The whole error is torque + k * omega^2 * slope.
torque = 4 * (sum - SUM);
slope = 2 * (s - S);

{ x in [-0.5, 0.5] /\ omega in [-1, 1] /\ alpha in [-1, 1] /\ sign in [-1, 1]
->
torque in [-22, 20] /\
slope in [-4, 0]
}

J -> jp0 + (jp1 + jp2 * x) * x;
S -> (jp1 + jp2 * x) + jp2 * x;
L -> lp0 + (lp1 + lp2 * x) * x;
B -> bp0 + (bp1 + bp2 * x) * x;
C -> cp0 + (cp1 + cp2 * x) * x;

# A place left of the middle, and one right of it.
torque $ x in (0);
