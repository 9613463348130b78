# The tick of Spline<Q31> and Spline16: Model::torque against the same formulas without a floor, for the words that the table
# has and the place that the tick reads.
#
# Everything is in raw units: j and the slope s of J (times two) as Layout::value_and_slope has them, the other curves likewise
# of their own words. x * u / 2 is Q31::step, x * omega / 2 Q31::product. No number wraps: the table was checked for that when
# it was built. k is the whole number that the velocity torque is of the slope a cell.
# A curve c is taken with its sign; sign is that of omega, or of omega and c: the magnitude of c errs by no more than c.

@floor = fixed<0, dn>;

j3 = floor(jp3 * u / 2);
j2 = jp2 + j3;
j1 = jp1 + floor(j2 * u / 2);
j = jp0 + floor(j1 * u / 2);
s = j1 + floor((j2 + j3) * u / 2);
load = lp0 + floor((lp1 + floor((lp2 + floor(lp3 * u / 2)) * u / 2)) * u / 2);
b = bp0 + floor((bp1 + floor((bp2 + floor(bp3 * u / 2)) * u / 2)) * u / 2);
c = cp0 + floor((cp1 + floor((cp2 + floor(cp3 * u / 2)) * u / 2)) * u / 2);
speed = floor(k * s * omega / 2) + b;
sum = floor(speed * omega / 2) + floor(j * alpha / 2) - load + c * sign;

# The same exactly: the sum in Q29, of the slope that the table reads.
J = jp0 + jp1 * u / 2 + jp2 * u * u / 4 + jp3 * u * u * u / 8;
S = jp1 + jp2 * u + jp3 * u * u * 3 / 4;
L = lp0 + lp1 * u / 2 + lp2 * u * u / 4 + lp3 * u * u * u / 8;
B = bp0 + bp1 * u / 2 + bp2 * u * u / 4 + bp3 * u * u * u / 8;
C = cp0 + cp1 * u / 2 + cp2 * u * u / 4 + cp3 * u * u * u / 8;
SUM = (k * s * omega / 2 + B) * omega / 2 + J * alpha / 2 - L + C * sign;

H3 = jp3 * u / 2;
H2 = jp2 + H3;
H1 = jp1 + H2 * u / 2;

# In units of 2^-31 of the torque base. The whole error is torque + k * omega^2 * slope.
torque = 4 * (sum - SUM);
slope = s - S;

{ u in [0, 1] /\ omega in [-1, 1] /\ alpha in [-1, 1] /\ sign in [-1, 1]
->
torque in [-24, 23] /\
slope in [-3.5, 0]
}

# Horner's scheme, twice over for the slope.
J -> jp0 + H1 * u / 2;
S -> H1 + (H2 + H3) * u / 2;
L -> lp0 + (lp1 + (lp2 + lp3 * u / 2) * u / 2) * u / 2;
B -> bp0 + (bp1 + (bp2 + bp3 * u / 2) * u / 2) * u / 2;
C -> cp0 + (cp1 + (cp2 + cp3 * u / 2) * u / 2) * u / 2;
