/* What the header computes inline, of encoders and counts that it is given: src/tests/encoder.rs compares the bits with those of Rust. */
#include <inttypes.h>
#include <stdio.h>

#include "jred.h"

int main(void) {
    char kind;
    while (scanf(" %c", &kind) == 1) {
        jred_encoder turn;
        jred_stroke_encoder stroke;
        int64_t count;
        uint32_t bits, reading;
        switch (kind) {
        case 't':
            if (scanf("%" SCNd32 "%" SCNu32 "%" SCNu64 "%" SCNd32 "%" SCNd64, &turn.lower, &turn.upper, &turn.start, &turn.rest, &count) != 5) return 1;
            printf("%" PRIu32 " %" PRIu32 "\n", jred_encoder_phase(&turn, (int32_t)(uint32_t)(uint64_t)count), jred_encoder_phase_wide(&turn, count));
            break;
        case 's': {
            if (scanf("%" SCNd64 "%" SCNd64 "%" SCNd64 "%" SCNd64 "%" SCNd64 "%" SCNu32 "%" SCNd32 "%" SCNd64, &stroke.step, &stroke.start,
                      &stroke.start_narrow, &stroke.middle, &stroke.reach, &stroke.part, &stroke.rest, &count) != 8)
                return 1;
            jred_place narrow = jred_stroke_encoder_phase(&stroke, (int32_t)(uint32_t)(uint64_t)count);
            jred_place wide = jred_stroke_encoder_phase_wide(&stroke, count);
            printf("%" PRIu32 " %d %" PRIu32 " %d\n", narrow.phase, narrow.limited, wide.phase, wide.limited);
            break;
        }
        case 'c':
            if (scanf("%" SCNu32 "%" SCNd64 "%" SCNu32, &bits, &count, &reading) != 3) return 1;
            printf("%" PRId64 "\n", jred_counter_extend(&count, bits, reading));
            break;
        default: return 1;
        }
    }
    return 0;
}
