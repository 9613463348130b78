/* A table exchanged by an interrupt, also in the middle of a tick: each torque is that of the one table or of the other. */
#ifndef __arm__
#define _XOPEN_SOURCE 700
#include <signal.h>
#include <sys/time.h>
#endif
#include <stdio.h>
#include <string.h>

#include "jred.h"
#include "../examples/press.h"

#define WORDS (sizeof press_words / sizeof press_words[0])
#define HEADER 24
#define POINTS 64
#define EXCHANGES 2000u

static uint32_t doubled[WORDS];
static press_model models[2];
/* A pointer is written at once: a tick reads it once, at its call. */
static const press_model *volatile current = &models[0];
static volatile uint32_t exchanges;

static void exchange(void) {
    current = current == &models[0] ? &models[1] : &models[0];
    exchanges++;
}

#ifdef __arm__
void systick(void) { exchange(); }

static void start(void) {
    volatile uint32_t *const timer = (volatile uint32_t *)0xe000e010;
    timer[1] = 7919; /* clocks: a prime, so that it hits every instruction of a tick */
    timer[2] = 0;
    timer[0] = 7;
}
#else
static void interrupted(int signal) {
    (void)signal;
    exchange();
}

static void start(void) {
    struct sigaction action;
    struct itimerval every = {{0, 53}, {0, 53}};
    memset(&action, 0, sizeof action);
    action.sa_handler = interrupted;
    sigaction(SIGALRM, &action, NULL);
    setitimer(ITIMER_REAL, &every, NULL);
}
#endif

static uint32_t crc(const uint32_t *words, size_t length) {
    uint32_t crc = 0xffffffffu;
    for (size_t k = 0; k < length; k++) {
        crc ^= words[k];
        for (int bit = 0; bit < 32; bit++) crc = crc >> 1 ^ (crc & 1u ? 0xedb88320u : 0u);
    }
    return ~crc;
}

static uint32_t torque(const press_model *model, uint32_t k) {
    uint32_t bits;
    const float found = press_torque(model, k * 0x9e3779b9u, 12.5f, -30.0f);
    memcpy(&bits, &found, sizeof bits);
    return bits;
}

int main(void) {
    static uint32_t expected[2][POINTS];
    uint32_t failures = 0, seen[2] = {0, 0};
    /* Twice the inertia and the load: the exponent of each figure, plus one. */
    memcpy(doubled, press_words, sizeof doubled);
    for (size_t k = HEADER; k < WORDS - 1; k++) doubled[k] += doubled[k] << 1 ? 1u << 23 : 0u;
    doubled[13] += doubled[13] << 1 ? 1u << 23 : 0u;
    doubled[WORDS - 1] = crc(doubled, WORDS - 1);
    if (press_load(&models[0]) != JRED_OK || press_load_words(&models[1], doubled, WORDS) != JRED_OK) return 1;
    for (uint32_t k = 0; k < POINTS; k++) {
        for (int n = 0; n < 2; n++) expected[n][k] = torque(&models[n], k);
        if (expected[0][k] == expected[1][k]) return 2;
    }
    start();
    while (exchanges < EXCHANGES) {
        for (uint32_t k = 0; k < POINTS; k++) {
            const uint32_t found = torque(current, k);
            const int other = found != expected[0][k];
            failures += found != expected[other][k];
            seen[other]++;
        }
    }
    printf("%lu failures\n", (unsigned long)failures);
    return failures != 0 || seen[0] == 0 || seen[1] == 0;
}
