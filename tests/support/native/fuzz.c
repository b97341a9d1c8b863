/* Random calls of the whole FMI 2.0 interface, wrong ones included, on several instances at once.
 *
 * fuzz SEED CALLS: prints how many calls were made and how many of them each status answered. Built
 * together with the sources of the FMU under AddressSanitizer and UBSan, which end the program on
 * the first fault. What an importer must not do at all (pointers that are neither NULL nor valid)
 * is left out.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"
#include "model.h"

#define INSTANCES 3
#define STATES    4
#define BLOB_ROOM (1 << 17)
#define SOME      8

/* Of a state: where its indices lie, which no blob may spoil, and the longest step to try [s]. */
#ifdef FUZZ_PLANT
#include "plant_variables.h"
#define INDICES 64u
#define LONGEST 0.2
typedef plant_parameters parameters;
#else
#include "apnc.h"
#define INDICES offsetof(apnc_state, estimation.oldest)
#define LONGEST 100.0
typedef apnc_parameters parameters;
#endif

static uint64_t random_state;
static long calls, answers[6], messages;
static long held_blocks, ticks;
static fmi2Component instance[INSTANCES];
static double now[INSTANCES];
static fmi2FMUstate state[INSTANCES][STATES];
static size_t state_count;
static char blob[BLOB_ROOM];
static size_t blob_size;

static uint32_t draw(uint32_t below) {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return (uint32_t)((random_state >> 11) % below);
}

static int one_in(uint32_t n) { return draw(n) == 0; }

static void fault(const char *what) {
    fprintf(stderr, "after %ld calls: %s\n", calls, what);
    abort();
}

static fmi2Status count(fmi2Status status) {
    calls++;
    if ((int)status < 0 || (int)status > 5) fault("no status of the standard");
    if (status == fmi2Fatal || status == fmi2Pending) fault("status that is never due");
    answers[status]++;
    return status;
}

static void log_message(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                        fmi2String category, fmi2String message, ...) {
    int listed = 0;
    (void)environment;
    if (!name || !category || !message || !*message) fault("message with a part missing");
    for (int k = 0; k < APNC_LOG_CATEGORIES; k++)
        listed = listed || strcmp(category, apnc_log_names[k]) == 0;
    if (!listed) fault("category that is not listed");
    /* importers take the message for a printf format, and '#' for a value reference */
    if (strpbrk(message, "%#")) fault("message with a sign that importers expand");
    if ((int)status < 0 || status > fmi2Error) fault("message with a wrong status");
    messages++;
}

static void *allocate(size_t n, size_t size) {
    void *memory = one_in(50) ? NULL : malloc(n * size);
    if (memory) {
        memset(memory, 0xA5, n * size);
        held_blocks++;
    }
    return memory;
}

static void release(void *memory) {
    if (memory) held_blocks--;
    free(memory);
}

static double odd_real(void) {
    static const double odd[] = {NAN,    INFINITY, -INFINITY, 0.0,   -0.0, 5e-324, 1e-310, 1e308,
                                 -1e308, 1.0,      -1.0,      1e150, 1e-9, 2.0,    1e9,    60.0};
    if (one_in(3)) return odd[draw(sizeof odd / sizeof *odd)];
    return (double)draw(1u << 20) / (double)(1u << (10 + draw(10)));
}

static fmi2ValueReference some_reference(void) {
    if (one_in(20)) return draw(UINT32_MAX);
    if (one_in(4)) return APNC_VR_STRIDE * draw(4) + draw(4); /* inputs */
    return APNC_VR_STRIDE * draw((uint32_t)apnc_variable_count + (uint32_t)one_in(30)) +
           draw(one_in(10) ? 100 : 4);
}

static const void *or_null(const void *pointer) { return one_in(60) ? NULL : pointer; }

static void make(int i) {
    static const fmi2CallbackFunctions with = {log_message, allocate, release, NULL, NULL};
    static const fmi2CallbackFunctions logger_only = {log_message, NULL, NULL, NULL, NULL};
    static const fmi2CallbackFunctions half = {NULL, allocate, NULL, NULL, NULL};
    const fmi2CallbackFunctions *choices[] = {&with, &with, &logger_only, &half, NULL};
    calls++;
    instance[i] = fmi2Instantiate(one_in(20) ? NULL : "fuzz", one_in(20) ? draw(5) : 1,
                                  one_in(20) ? "{x}" : or_null(APNC_GUID), or_null("file:///x"),
                                  choices[draw(5)], (fmi2Boolean)draw(2), (fmi2Boolean)draw(2));
    now[i] = 0.0;
}

/* What belongs to an instance goes before it does. */
static void unmake(int i) {
    for (int k = 0; k < STATES; k++) {
        if (state[i][k]) {
            count(fmi2FreeFMUstate(instance[i], &state[i][k]));
            if (state[i][k]) fault("state is not freed");
            state_count--;
        }
    }
    calls++;
    fmi2FreeInstance(instance[i]);
    instance[i] = NULL;
}

static void set_values(fmi2Component c) {
    fmi2ValueReference vr[SOME];
    fmi2Real real[SOME];
    fmi2Integer integer[SOME];
    fmi2String string[SOME];
    const size_t n = draw(SOME);
    for (size_t k = 0; k < SOME; k++) {
        vr[k] = some_reference();
        real[k] = odd_real();
        integer[k] = one_in(4) ? (fmi2Integer)draw(UINT32_MAX) : (fmi2Integer)draw(5);
        string[k] = or_null("x");
    }
    switch (draw(6)) {
    case 0:
        count(fmi2SetInteger(c, or_null(vr), n, or_null(integer)));
        break;
    case 1:
        count(fmi2SetBoolean(c, or_null(vr), n, or_null(integer)));
        break;
    case 2:
        count(fmi2SetString(c, or_null(vr), n, or_null(string)));
        break;
    case 3:
        count(fmi2SetRealInputDerivatives(c, or_null(vr), n, or_null(integer), real));
        break;
    default:
        count(fmi2SetReal(c, or_null(vr), n, or_null(real)));
    }
}

static void get_values(fmi2Component c) {
    fmi2ValueReference vr[SOME];
    fmi2Real real[SOME];
    fmi2Integer integer[SOME] = {0};
    fmi2String string[SOME];
    const size_t n = draw(SOME);
    for (size_t k = 0; k < SOME; k++) vr[k] = some_reference();
    switch (draw(6)) {
    case 0:
        count(fmi2GetInteger(c, or_null(vr), n, (void *)or_null(integer)));
        break;
    case 1:
        count(fmi2GetBoolean(c, or_null(vr), n, (void *)or_null(integer)));
        break;
    case 2:
        count(fmi2GetString(c, or_null(vr), n, (void *)or_null(string)));
        break;
    case 3:
        count(fmi2GetRealOutputDerivatives(c, or_null(vr), n, or_null(integer), real));
        break;
    case 4:
        count(fmi2GetDirectionalDerivative(c, vr, n, vr, n, real, real));
        break;
    default:
        count(fmi2GetReal(c, or_null(vr), n, (void *)or_null(real)));
    }
}

static void step(int i) {
    double t = now[i], h = 1.0 / 60.0;
    if (one_in(4)) h *= (double)draw(1000) / 50.0;
    if (one_in(20)) t = odd_real();
    if (one_in(20)) h = odd_real();
    if (h > LONGEST && h < 1e12) h = LONGEST; /* long steps are tried, but not all day */
    if (count(fmi2DoStep(instance[i], t, h, fmi2True)) > fmi2Warning) return;
    now[i] = t + h;
    if (h < 1e3) ticks += (long)(h * 60.0);
}

static uint64_t checksum(const unsigned char *bytes, size_t size) {
    uint64_t hash = 14695981039346656037u;
    for (size_t k = 0; k < size; k++) hash = (hash ^ bytes[k]) * 1099511628211u;
    return hash;
}

/* Spoils the blob; sometimes so that its checksum is right again, as a hostile file would. */
static void spoil(void) {
    const size_t header = blob_size - apnc_saved_size();
    const size_t parts[] = {0, apnc_state_at(), apnc_run_at(), apnc_state_at() + INDICES};
    const size_t sizes[] = {sizeof(parameters), apnc_state_size(), sizeof(apnc_run),
                            12 * sizeof(int32_t)};
    for (uint32_t k = draw(4); k > 0; k--) {
        const uint32_t part = draw(4);
        const size_t at = header + parts[part] + draw((uint32_t)sizes[part]);
        const double number = odd_real();
        switch (draw(4)) {
        case 0:
            memset(blob + at / 8 * 8, one_in(2) ? 0xFF : 0x7F, 8);
            break;
        case 1:
            memcpy(blob + at / 8 * 8, &number, sizeof number);
            break;
        default:
            blob[at] ^= (char)(1 << draw(8));
        }
    }
    if (one_in(2)) {
        const uint64_t sum = checksum((unsigned char *)blob + header, apnc_saved_size());
        memcpy(blob + header - sizeof sum, &sum, sizeof sum);
    }
}

static void use_states(int i) {
    fmi2FMUstate *s = &state[i][draw(STATES)];
    const int had = *s != NULL;
    size_t size = 0;
    switch (draw(6)) {
    case 0:
        count(fmi2GetFMUstate(instance[i], one_in(60) ? NULL : s));
        break;
    case 1:
        count(fmi2SetFMUstate(instance[i], *s));
        break;
    case 2:
        count(fmi2FreeFMUstate(instance[i], one_in(60) ? NULL : s));
        break;
    case 3:
        if (count(fmi2SerializedFMUstateSize(instance[i], *s, &size)) != fmi2OK) break;
        if (size > BLOB_ROOM) fault("saved state is larger than expected");
        if (one_in(10)) size = draw((uint32_t)size);
        if (count(fmi2SerializeFMUstate(instance[i], *s, blob, size)) == fmi2OK) blob_size = size;
        break;
    case 4:
        if (!blob_size) break;
        if (one_in(2)) spoil();
        size = one_in(10) ? draw((uint32_t)blob_size) : blob_size;
        /* an exact copy, so that reading past its end is seen */
        char *copy = malloc(size + !size);
        memcpy(copy, blob, size);
        if (count(fmi2DeSerializeFMUstate(instance[i], copy, size, s)) == fmi2OK && one_in(2))
            count(fmi2SetFMUstate(instance[i], *s));
        free(copy);
        break;
    default:
        count(fmi2SerializedFMUstateSize(instance[i], *s, NULL));
    }
    state_count += (size_t)((*s != NULL) - had);
}

static void ask(fmi2Component c) {
    fmi2Status status;
    fmi2Real real;
    fmi2Integer integer;
    fmi2String string;
    const fmi2StatusKind kind = (fmi2StatusKind)draw(6);
    switch (draw(6)) {
    case 0:
        count(fmi2GetStatus(c, kind, &status));
        break;
    case 1:
        count(fmi2GetRealStatus(c, kind, &real));
        break;
    case 2:
        count(fmi2GetIntegerStatus(c, kind, &integer));
        break;
    case 3:
        count(fmi2GetBooleanStatus(c, kind, &integer));
        break;
    case 4:
        count(fmi2GetStringStatus(c, kind, &string));
        break;
    default:
        count(fmi2CancelStep(c));
    }
}

static void switch_logging(fmi2Component c) {
    const fmi2String names[] = {"logStatusError", one_in(4) ? NULL : "logEvents", "other"};
    count(fmi2SetDebugLogging(c, (fmi2Boolean)draw(2), draw(4), or_null(names)));
}

/* Straight to stepping, where most of the code is. */
static void begin(int i) {
    const double start = one_in(5) ? odd_real() : 0.0;
    count(fmi2Reset(instance[i]));
    for (uint32_t k = draw(4); k > 0; k--) set_values(instance[i]);
    if (count(fmi2SetupExperiment(instance[i], fmi2False, 0.0, start, fmi2False, 0.0)) == fmi2OK)
        now[i] = start;
    else
        now[i] = 0.0;
    count(fmi2EnterInitializationMode(instance[i]));
    if (count(fmi2ExitInitializationMode(instance[i])) == fmi2OK) return;
    count(fmi2Reset(instance[i]));
    count(fmi2EnterInitializationMode(instance[i]));
    count(fmi2ExitInitializationMode(instance[i]));
    now[i] = 0.0;
}

static void live(fmi2Component c, int i) {
    switch (draw(12)) {
    case 0:
        count(fmi2Terminate(c));
        break;
    case 1:
        count(fmi2Reset(c));
        break;
    case 2:
        count(fmi2SetupExperiment(c, (fmi2Boolean)draw(2), odd_real(), odd_real(),
                                  (fmi2Boolean)draw(2), odd_real()));
        break;
    case 3:
        count(fmi2EnterInitializationMode(c));
        break;
    case 4:
        count(fmi2ExitInitializationMode(c));
        break;
    default:
        if (c) begin(i);
    }
}

int main(int argc, char **argv) {
    if (argc != 3) return 2;
    random_state = strtoull(argv[1], NULL, 10) * 2654435769u + 88172645463325252u;
    const long wanted = strtol(argv[2], NULL, 10);
    while (calls < wanted) {
        const int i = (int)draw(INSTANCES);
        fmi2Component c = instance[i];
        if (!c && !one_in(20)) {
            make(i);
            continue;
        }
        switch (draw(40)) {
        case 0:
            if (c && one_in(4)) unmake(i);
            break;
        case 1:
            switch_logging(c);
            break;
        case 2:
        case 3:
            ask(c);
            break;
        case 4:
        case 5:
        case 6:
        case 7:
        case 8:
            live(c, i);
            break;
        case 9:
        case 10:
        case 11:
        case 12:
        case 13:
        case 14:
            if (c) use_states(i);
            break;
        case 15:
        case 16:
        case 17:
        case 18:
        case 19:
            set_values(c);
            break;
        case 20:
        case 21:
        case 22:
        case 23:
        case 24:
        case 25:
            get_values(c);
            break;
        default:
            if (c)
                step(i);
            else
                count(fmi2DoStep(NULL, 0.0, 1.0, fmi2True));
        }
    }
    for (int i = 0; i < INSTANCES; i++)
        if (instance[i]) unmake(i);
    if (held_blocks || state_count) fault("memory of the importer is still held");
    printf(
        "%ld calls, about %ld ticks: %ld ok, %ld warning, %ld discard, %ld error; %ld messages\n",
        calls, ticks, answers[fmi2OK], answers[fmi2Warning], answers[fmi2Discard],
        answers[fmi2Error], messages);
    return 0;
}
