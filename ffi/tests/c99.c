/* The reader in plain C99, of images that it is given: src/tests/c99.rs compares the bits with those of the library. */
#include <inttypes.h>
#include <stdio.h>

#include "jred99.h"

static uint32_t words[4096];

static uint32_t f32_bits(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return x != x ? 0x7fc00000u : bits;
}

int main(void) {
    static jred99_table table;
    char kind;
    uint32_t in[4];
    size_t length;
    while (scanf(" %c", &kind) == 1) {
        if (kind == 'i') {
            if (scanf("%zu", &length) != 1 || length > 4096) return 1;
            for (size_t k = 0; k < length; k++)
                if (scanf("%" SCNx32, &words[k]) != 1) return 1;
            printf("%d\n", (int)jred99_load(&table, words, length));
            continue;
        }
        for (int k = 0; k < 4; k++)
            if (scanf("%" SCNx32, &in[k]) != 1) return 1;
        if (kind == 'f') {
            const float x = jred99_float_(in[1]), y = jred99_float_(in[2]), z = jred99_float_(in[3]);
            printf("%" PRIx32 " %" PRIx32 "\n", f32_bits(jred99_f32_torque(&table, in[0], x, y, z)),
                   f32_bits(jred99_f32_acceleration(&table, in[0], x, y, z)));
        } else if (kind == 'l') {
            const int32_t x = jred99_signed_(in[1]), y = jred99_signed_(in[2]), z = jred99_signed_(in[3]);
            printf("%" PRIx32 "\n", (uint32_t)jred99_q31_torque(&table, in[0], x, y, z));
        } else {
            const int16_t x = (int16_t)jred99_signed_(in[1]), y = (int16_t)jred99_signed_(in[2]), z = (int16_t)jred99_signed_(in[3]);
            printf("%" PRIx32 " %" PRIx32 "\n", (uint32_t)(int32_t)jred99_q15_torque(&table, in[0], x, y, z),
                   (uint32_t)(int32_t)jred99_q15_acceleration(&table, in[0], x, y, z));
        }
    }
    return 0;
}
