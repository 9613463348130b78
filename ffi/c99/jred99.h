/* A table of jred in plain C99, for processors that the library does not reach: Xtensa, dsPIC, C2000 with its char of 16 bits. One header, nothing to
 * link. Written from docs/table-image.md; the bits are those of the library.
 *
 *     static jred99_table press;
 *     if (jred99_load(&press, press_words, 292) != JRED99_OK) ...                         once; the words must stay
 *     float torque = jred99_f32_torque(&press, phase, omega, alpha, omega);               in every tick
 *
 * It takes what `jred export --format c` writes with --layout spline (--type f32 or i32) and --type i16. phase is in units of 2^-32 of the range, the
 * numbers are in the units of the table: SI, or shares of its bases. Coulomb friction has the sign of the last argument, a speed: the set-point's. It
 * needs int32_t and int64_t, and for the same bits no fused multiplication and addition: -ffp-contract=off, or a compiler that obeys the pragma;
 * and FLT_EVAL_METHOD 0, so that float is evaluated as float. NaN of speed or acceleration gives NaN; friction of a NaN speed is that of a positive one,
 * as in the library. A table must not be loaded while it is ticked.
 *
 * Checked: header, length, CRC, set, and that the rows fit. That the numbers are those of a machine, the command has checked before it wrote the CRC. */
#ifndef JRED99_H
#define JRED99_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#if defined(__STDC_VERSION__) && (!defined(__GNUC__) || defined(__clang__))
#pragma STDC FP_CONTRACT OFF
#endif

typedef enum {
    JRED99_OK,
    JRED99_NULL,
    JRED99_LENGTH,  /* truncated, padded, or not the rows of this set */
    JRED99_MAGIC,   /* no image */
    JRED99_VERSION, /* another version of the layout */
    JRED99_CRC,     /* damaged */
    JRED99_HEADER,  /* a word of the header has no meaning */
    JRED99_FORMAT   /* another number type or layout than those above */
} jred99_status;

typedef enum { JRED99_NONE, JRED99_F32, JRED99_Q31, JRED99_Q15 } jred99_number;

typedef struct {
    const uint32_t *rows;
    jred99_number number;
    uint32_t set, cells, pitch;
    uint32_t inertia, viscous, coulomb; /* constants, as they are stored; of i16 the first is the shift of 1/J */
    float factor_f32;                   /* of the velocity torque */
    int32_t factor;
    float from, to; /* the stroke; 0, 0 for a turn */
    float torque_base, speed_base, acceleration_base;
    float max_speed, max_acceleration, torque_error;
    uint32_t machine;
} jred99_table;

/* ---- words ------------------------------------------------------------------------------------------------------- */

static inline float jred99_float_(uint32_t bits) {
    float x;
    (void)memcpy(&x, &bits, sizeof x);
    return x;
}
static inline int32_t jred99_signed_(uint32_t x) { return x <= 0x7fffffffu ? (int32_t)x : -(int32_t)(0xffffffffu - x) - 1; }
/* x/2^n, rounded down. */
static inline int32_t jred99_down_(int32_t x, int n) { return x >= 0 ? x >> n : -1 - ((-1 - x) >> n); }
static inline int32_t jred99_lower_(uint32_t word) { return (int32_t)((word & 0xffffu) ^ 0x8000u) - 0x8000; }
/* The upper word of a product of signed numbers, rounded down. */
static inline uint32_t jred99_high_(uint32_t a, uint32_t b) {
    return (uint32_t)((uint64_t)((int64_t)jred99_signed_(a) * jred99_signed_(b)) >> 32);
}

static inline uint32_t jred99_crc_(const uint32_t *words, size_t length) {
    uint32_t crc = 0xffffffffu;
    for (size_t k = 0; k < length; k++) {
        crc ^= words[k];
        for (int bit = 0; bit < 32; bit++) crc = crc >> 1 ^ ((crc & 1u) != 0u ? 0xedb88320u : 0u);
    }
    return crc ^ 0xffffffffu;
}

/* Curves in a row, of these bits of the set: load 1, b 2, c 4, 1/J 8; a constant b 16, a constant c 32. */
static inline uint32_t jred99_curves_(uint32_t set) { return (set & 1u) + (set >> 1 & 1u) + (set >> 2 & 1u) + (set >> 3 & 1u); }

static inline bool jred99_positive_(float x) { return x > 0.0f && x <= 3.4028235e38f; }

static inline jred99_status jred99_load(jred99_table *table, const uint32_t *words, size_t length) {
    if (table == NULL) return JRED99_NULL;
    (void)memset(table, 0, sizeof *table); /* no table: number is JRED99_NONE, and every tick 0 */
    if (words == NULL) return JRED99_NULL;
    if (length < 25u) return JRED99_LENGTH;
    if (words[0] != 0x4445524au) return JRED99_MAGIC;
    if ((words[1] & 0xffffu) != 2u) return JRED99_VERSION;
    if (words[2] != length) return JRED99_LENGTH;
    if (jred99_crc_(words, length - 1u) != words[length - 1u]) return JRED99_CRC;

    const uint32_t number = words[3] & 0xffu, set = words[3] >> 8 & 0xffu, layout = words[3] >> 16 & 0xffu, stroke = words[3] >> 24;
    const uint32_t cells = words[4], constants = set >> 4u, curves = jred99_curves_(set);
    const float from = jred99_float_(words[5]), to = jred99_float_(words[6]);
    const float torque = jred99_float_(words[7]), speed = jred99_float_(words[8]), inertia = jred99_float_(words[9]);
    const float span = stroke == 0u ? 6.28318530717958647692f : to - from;
    const float bases = inertia * speed / torque * speed, factor = 0.5f * (float)cells / span * bases;
    if (words[1] >> 16 != 24u || stroke > 1u || set > 63u || (words[20] | words[21] | words[22] | words[23]) != 0u) return JRED99_HEADER;
    if (!jred99_positive_(span) || !jred99_positive_(torque) || !jred99_positive_(speed) || !jred99_positive_(inertia)) return JRED99_HEADER;
    for (int k = 10; k < 13; k++)
        if (!jred99_positive_(jred99_float_(words[k])) && jred99_float_(words[k]) != 0.0f) return JRED99_HEADER;
    if (!jred99_positive_(factor) || !jred99_positive_(torque / inertia) || (set >> 1u & constants & 3u) != 0u) return JRED99_HEADER;
    const bool spline = layout == 1u && (number == 1u || number == 2u);
    if (!spline && !(layout == 5u && number == 3u)) return JRED99_FORMAT;
    if (number == 1u && (set & 8u) != 0u) return JRED99_FORMAT;
    table->pitch = spline ? 1u + curves : 3u + curves;
    if (cells < 4u || cells > 65535u || length != 25u + (cells + (spline ? 3u : 0u)) * table->pitch) return JRED99_LENGTH;
    for (uint32_t k = 0u; spline && stroke == 0u && k < 3u * table->pitch; k++)
        if (words[24u + k] != words[24u + cells * table->pitch + k]) return JRED99_HEADER;
    if (number == 2u) {
        /* A whole number, but for the rounding of its bases. */
        table->factor = factor < 1e6f ? (int32_t)(factor + 0.5f) : 0;
        if (table->factor == 0 || fabsf(factor - (float)table->factor) > 1e-6f * factor) return JRED99_HEADER;
    }
    if (number == 3u && (set & 8u) != 0u && words[13] > 15u) return JRED99_HEADER;
    table->rows = words + 24;
    table->set = set;
    table->cells = cells;
    table->inertia = words[13];
    table->viscous = words[14];
    table->coulomb = words[15];
    table->factor_f32 = factor;
    table->from = from;
    table->to = to;
    table->torque_base = torque;
    table->speed_base = speed;
    table->acceleration_base = torque / inertia;
    table->max_speed = jred99_float_(words[10]);
    table->max_acceleration = jred99_float_(words[11]);
    table->torque_error = jred99_float_(words[12]);
    table->machine = words[19];
    table->number = number == 1u ? JRED99_F32 : number == 2u ? JRED99_Q31 : JRED99_Q15;
    return JRED99_OK;
}

/* ---- spline in single precision ---------------------------------------------------------------------------------- */

/* Value, and slope if wanted, of the curve in a column. */
static inline float jred99_f32_curve_(const jred99_table *table, const uint32_t *cell, uint32_t column, float u, float *slope) {
    float c[4];
    for (uint32_t k = 0; k < 4; k++) c[k] = jred99_float_(cell[k * table->pitch + column]);
    const float d0 = c[1] - c[0], d1 = c[2] - c[1], d2 = c[3] - c[2], s0 = d1 - d0, s1 = d2 - d1;
    const float p0 = c[1] * 6.0f + s0, p1 = (d0 + d1) * 3.0f, p2 = s0 * 3.0f, p3 = s1 - s0;
    const float t3 = p3 * u, b2 = p2 + t3, b1 = p1 + b2 * u;
    if (slope == NULL) return p0 + b1 * u;
    *slope = b1 + (b2 + t3) * u;
    return p0 + jred99_float_(table->inertia) + b1 * u;
}

/* The resisting torque, after J*alpha if there is an acceleration; J alone in *inertia. */
static inline float jred99_f32_sum_(const jred99_table *table, uint32_t phase, float omega, const float *alpha, float friction, float *inertia) {
    const uint64_t place = (uint64_t)phase * table->cells;
    const uint32_t *cell = table->rows + (size_t)(place >> 32) * table->pitch;
    const float u = (float)(uint32_t)(place & 0xffffffffu) * (1.0f / 4294967296.0f);
    uint32_t column = 1;
    float slope;
    *inertia = jred99_f32_curve_(table, cell, 0, u, &slope);
    const float load = (table->set & 1u) != 0u ? jred99_f32_curve_(table, cell, column++, u, NULL) : 0.0f;
    float per_speed = slope * table->factor_f32 * omega;
    if ((table->set & 2u) != 0u) per_speed += jred99_f32_curve_(table, cell, column++, u, NULL);
    if ((table->set & 16u) != 0u) per_speed += jred99_float_(table->viscous);
    float sum = alpha == NULL ? per_speed * omega : *inertia * *alpha + per_speed * omega;
    if ((table->set & 1u) != 0u) sum -= load;
    if ((table->set & 36u) != 0u && friction != 0.0f) {
        const float c = fabsf((table->set & 4u) != 0u ? jred99_f32_curve_(table, cell, column, u, NULL) : jred99_float_(table->coulomb));
        sum += friction < 0.0f ? -c : c;
    }
    return sum;
}

static inline float jred99_f32_torque(const jred99_table *table, uint32_t phase, float omega, float alpha, float friction) {
    float inertia;
    if (table->number != JRED99_F32) return 0.0f;
    return jred99_f32_sum_(table, phase, omega, &alpha, friction, &inertia);
}

static inline float jred99_f32_acceleration(const jred99_table *table, uint32_t phase, float omega, float torque, float friction) {
    float inertia;
    if (table->number != JRED99_F32) return 0.0f;
    const float resisting = jred99_f32_sum_(table, phase, omega, NULL, friction, &inertia);
    return (torque - resisting) / inertia;
}

/* ---- spline in fixed point: sums are modulo 2^32, as in the library ---------------------------------------------- */

static inline uint32_t jred99_q31_curve_(const jred99_table *table, const uint32_t *cell, uint32_t column, uint32_t u, uint32_t *slope) {
    const uint32_t w = table->pitch, *c = cell + column;
    const uint32_t d0 = c[w] - c[0], d1 = c[2 * w] - c[w], d2 = c[3 * w] - c[2 * w], s0 = d1 - d0, s1 = d2 - d1;
    const uint32_t p0 = c[w] * 6u + s0, p1 = (d0 + d1) * 6u, p2 = s0 * 12u, p3 = (s1 - s0) * 8u;
    const uint32_t t3 = jred99_high_(p3, u), b2 = p2 + t3, b1 = p1 + jred99_high_(b2, u);
    if (slope == NULL) return p0 + jred99_high_(b1, u);
    *slope = b1 + jred99_high_(b2 + t3, u);
    return p0 + table->inertia + jred99_high_(b1, u);
}

static inline int32_t jred99_q31_torque(const jred99_table *table, uint32_t phase, int32_t omega, int32_t alpha, int32_t friction) {
    if (table->number != JRED99_Q31) return 0;
    const uint64_t place = (uint64_t)phase * table->cells;
    const uint32_t *cell = table->rows + (size_t)(place >> 32) * table->pitch;
    const uint32_t u = (uint32_t)(place & 0xffffffffu) >> 1, w = (uint32_t)omega, set = table->set;
    uint32_t column = 1, slope;
    const uint32_t inertia = jred99_q31_curve_(table, cell, 0, u, &slope);
    const uint32_t load = (set & 1u) != 0u ? jred99_q31_curve_(table, cell, column++, u, NULL) : 0;
    uint32_t per_speed = jred99_high_(slope * (uint32_t)table->factor, w);
    if ((set & 2u) != 0u) per_speed += jred99_q31_curve_(table, cell, column++, u, NULL);
    if ((set & 16u) != 0u) per_speed += table->viscous;
    uint32_t sum = jred99_high_(inertia, (uint32_t)alpha) + jred99_high_(per_speed, w) - load;
    if ((set & 36u) != 0u && friction != 0) {
        const uint32_t c = (set & 4u) != 0u ? jred99_q31_curve_(table, cell, column, u, NULL) : table->coulomb;
        sum += ((c ^ (uint32_t)friction) & 0x80000000u) != 0u ? 0u - c : c;
    }
    return jred99_signed_(sum << 2);
}

/* ---- 16-bit rows ------------------------------------------------------------------------------------------------- */

static inline int32_t jred99_line_(uint32_t word, uint32_t u) {
    return jred99_down_(jred99_signed_(word + (uint32_t)jred99_lower_(word) * u), 16);
}

/* J*alpha + resisting torque, in units of 2^-31; what divides in *inertia: 1/J if the set has it. */
static inline uint32_t jred99_q15_sum_(const jred99_table *table, uint32_t phase, int16_t omega, int16_t alpha, int16_t friction,
                                       int32_t *inertia) {
    const uint64_t place = (uint64_t)phase * table->cells;
    const uint32_t *row = table->rows + (size_t)(place >> 32) * table->pitch, *g = row;
    const uint32_t u = (uint32_t)(place & 0xffffffffu) >> 16, set = table->set, w = (uint32_t)(int32_t)omega, a = (uint32_t)(int32_t)alpha;
    if ((set & 1u) != 0u) row++;
    const int32_t velocity = jred99_line_(row[1], u);
    const uint32_t start = row[2], *more = row + 3;
    const uint32_t mass = (start + (uint32_t)jred99_line_(row[0], u) * u) >> 16;
    uint32_t per_speed = (uint32_t)velocity * w + 0x2000u, sum;
    if ((set & 2u) != 0u) per_speed += (uint32_t)jred99_line_(*more++, u) << 15;
    if ((set & 16u) != 0u) per_speed += table->viscous;
    sum = (uint32_t)jred99_down_(jred99_signed_(per_speed), 14) * w;
    if ((set & 4u) != 0u || (set & 32u) != 0u) {
        const int32_t line = (set & 4u) != 0u ? jred99_line_(*more++, u) : 0;
        const uint32_t c = (set & 4u) != 0u ? (uint32_t)(line < 0 ? -line : line) << 16 : table->coulomb;
        sum += friction > 0 ? c : friction < 0 ? 0u - c : 0;
    }
    if (inertia != NULL) *inertia = (set & 8u) != 0u ? jred99_line_(*more, u) : (int32_t)mass;
    sum += mass * a;
    return (set & 1u) != 0u ? sum + (start << 16) + (uint32_t)jred99_line_(*g, u) * u : sum + 0x8000u;
}

static inline int16_t jred99_q15_torque(const jred99_table *table, uint32_t phase, int16_t omega, int16_t alpha, int16_t friction) {
    if (table->number != JRED99_Q15) return 0;
    return (int16_t)jred99_down_(jred99_signed_(jred99_q15_sum_(table, phase, omega, alpha, friction, NULL)), 16);
}

/* Limited to 16 bits. */
static inline int16_t jred99_q15_acceleration(const jred99_table *table, uint32_t phase, int16_t omega, int16_t torque, int16_t friction) {
    if (table->number != JRED99_Q15) return 0;
    const uint32_t set = table->set;
    int32_t inertia, resisting, found;
    if ((set & ~8u) == 0) {
        const uint64_t place = (uint64_t)phase * table->cells;
        const int32_t velocity = jred99_line_(table->rows[(size_t)(place >> 32) * table->pitch + 1], (uint32_t)(place & 0xffffffffu) >> 16);
        resisting = jred99_down_(jred99_down_(velocity * omega, 15) * omega, 15);
        (void)jred99_q15_sum_(table, phase, 0, 0, 0, &inertia);
    } else {
        resisting = jred99_down_(jred99_signed_(jred99_q15_sum_(table, phase, omega, 0, friction, &inertia)), 16);
    }
    const int32_t net = (int32_t)torque - resisting;
    if ((set & 8u) != 0u) {
        found = jred99_down_(jred99_signed_((uint32_t)inertia * (uint32_t)net), (int)table->inertia);
    } else {
        const uint32_t size = net < 0 ? (uint32_t)-net : (uint32_t)net;
        if (size << 1 >= (uint32_t)inertia) return net < 0 ? INT16_MIN : INT16_MAX;
        found = (int32_t)((size << 16) / (uint32_t)inertia);
        found = net < 0 ? -found : found;
    }
    return found > INT16_MAX ? INT16_MAX : found < INT16_MIN ? INT16_MIN : (int16_t)found;
}

#endif
