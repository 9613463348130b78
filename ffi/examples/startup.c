/* What a Cortex-M needs before main: vectors, data, and the floating-point unit if there is one. Any board's start-up code does. */
#include <stdint.h>
#include <stdlib.h>

extern uint32_t data_source, data_start, data_end, bss_start, bss_end, stack_top;
int main(void);
void initialise_monitor_handles(void); /* newlib: printf by semihosting */
void reset(void);

static void fault(void) { abort(); }
/* A program that starts the timer has its own. */
__attribute__((weak)) void systick(void) { abort(); }

__attribute__((section(".vectors"), used)) static const void *const vectors[16] = {
    &stack_top, (const void *)reset, (const void *)fault, (const void *)fault, (const void *)fault, (const void *)fault,
    [15] = (const void *)systick,
};

void reset(void) {
    for (uint32_t *to = &data_start, *from = &data_source; to < &data_end;) *to++ = *from++;
    for (uint32_t *to = &bss_start; to < &bss_end;) *to++ = 0;
#ifdef __ARM_FP
    *(volatile uint32_t *)0xe000ed88 |= 0xfu << 20; /* CPACR: coprocessors 10 and 11 */
    __asm volatile("dsb\n isb");
#endif
    initialise_monitor_handles();
    exit(main());
}
