/* The core alone over the loads of a walk: prints the joint commands, stored phases and kappa of
 * every tick, then instructions per tick, instructions counted for 4000, bytes of state and of
 * variables. On a bare Cortex-M the instructions are counted, elsewhere they are 0.
 *
 * QEMU runs the former with semihosting and -icount shift=0, under which an instruction takes 1 ns;
 * the SysTick timer, at the boards' 25 MHz, counts every 40 of them.
 */
#include <stdint.h>
#include <stdio.h>

#include "apnc.h"
#include "loads.h" /* const int16_t loads[TICKS][4], in 0.01 N, written by the test */

static apnc_data data;
static apnc_state state;

#ifdef __arm__
#define SYSTICK            ((volatile uint32_t *)0xE000E010) /* control, reload, value */
#define COPROCESSOR_ACCESS ((volatile uint32_t *)0xE000ED88)

extern uint32_t data_begin, data_end, data_stored, stack_top;
extern void initialise_monitor_handles(void);
extern void exit(int);
int main(void);

static uint32_t now(void) { return SYSTICK[2]; }

/* Timer counts as instructions; the timer counts down. */
static uint32_t since(uint32_t begin) { return 40 * ((begin - SYSTICK[2]) & 0xFFFFFF); }

static void begin(void) {
    initialise_monitor_handles();
    SYSTICK[1] = 0xFFFFFF;
    SYSTICK[0] = 5; /* on, at the processor's clock, without interrupt */
}

static void four_thousand(void) { __asm__ volatile(".rept 4000\n nop\n .endr"); }

void _init(void) {}
void _fini(void) {}

void reset(void) {
    *COPROCESSOR_ACCESS |= 0xF << 20; /* floating point */
    for (uint32_t *to = &data_begin, *from = &data_stored; to < &data_end;) *to++ = *from++;
    exit(main());
}

__attribute__((section(".vectors"), used)) static void (*const vectors[])(void) = {
    (void (*)(void))(uintptr_t)&stack_top, reset};
#else
static uint32_t now(void) { return 0; }
static uint32_t since(uint32_t begin) { return begin; }
static void begin(void) {}
static void four_thousand(void) {}
#endif

int main(void) {
    uint32_t instructions = 0;
    begin();
    uint32_t before = now();
    four_thousand();
    const uint32_t counted = since(before);
    apnc_defaults(&data);
    data.inputs.MI = (apnc_real)0.08;
    apnc_init(&data.parameters, &state, &data.outputs);
    for (int n = 0; n < TICKS; n++) {
        for (int leg = 0; leg < APNC_LEGS; leg++)
            data.inputs.grf[leg] = (apnc_real)loads[n][leg] / 100;
        before = now();
        apnc_tick(&data.parameters, &state, &data.inputs, &data.outputs);
        instructions += since(before);
        for (int leg = 0; leg < APNC_LEGS; leg++)
            printf("%.17g %.17g ", (double)data.outputs.theta_hip[leg],
                   (double)data.outputs.theta_knee[leg]);
        for (int r = 0; r < APNC_RELATIONS; r++)
            printf("%.17g ", (double)data.outputs.phi_memory[r]);
        printf("%.17g\n", (double)data.outputs.kappa);
    }
    printf("%lu %lu %lu %lu\n", (unsigned long)(instructions / TICKS), (unsigned long)counted,
           (unsigned long)sizeof state, (unsigned long)sizeof data);
    return 0;
}
