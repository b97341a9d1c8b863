/* As fuzz.c, for FMI 3.0: random calls, wrong ones included, on several instances at once. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi3_standard.h"
#include "model.h"

#define INSTANCES 3
#define STATES    4
#define BLOB_ROOM (1 << 17)
#define SOME      6
#define VALUES    (2 * APNC_LEGS * SOME)

static uint64_t random_state;
static long calls, answers[6], messages, ticks;
static fmi3Instance instance[INSTANCES];
static double now[INSTANCES];
static fmi3FMUState state[INSTANCES][STATES];
static fmi3Byte blob[BLOB_ROOM];
static size_t blob_size;

static uint32_t draw(uint32_t below) {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return (uint32_t)((random_state >> 11) % below);
}

static int one_in(uint32_t n) { return draw(n) == 0; }

static const void *or_null(const void *pointer) { return one_in(60) ? NULL : pointer; }

static void fault(const char *what) {
    fprintf(stderr, "after %ld calls: %s\n", calls, what);
    abort();
}

static fmi3Status count(fmi3Status status) {
    calls++;
    if ((int)status < 0 || status >= fmi3Fatal) fault("status that is never due");
    answers[status]++;
    return status;
}

static void log_message(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                        fmi3String message) {
    int listed = 0;
    (void)environment;
    if (!category || !message || !*message) fault("message with a part missing");
    for (int k = 0; k < APNC_LOG_CATEGORIES; k++)
        listed = listed || strcmp(category, apnc_log_names[k]) == 0;
    if (!listed) fault("category that is not listed");
    if ((int)status < 0 || status > fmi3Error) fault("message with a wrong status");
    messages++;
}

static double odd_real(void) {
    static const double odd[] = {NAN,    INFINITY, -INFINITY, 0.0,   -0.0, 5e-324, 1e-310, 1e308,
                                 -1e308, 1.0,      -1.0,      1e150, 1e-9, 2.0,    1e9,    60.0};
    if (one_in(3)) return odd[draw(sizeof odd / sizeof *odd)];
    return (double)draw(1u << 20) / (double)(1u << (10 + draw(10)));
}

/* References of whole variables, mostly of one type, and how many values they have together. */
static size_t pick(fmi3ValueReference *vr, size_t n, apnc_type type) {
    size_t values = 0;
    for (size_t k = 0; k < n; k++) {
        uint32_t number = draw((uint32_t)apnc_variable_count);
        while (!one_in(40) && apnc_variables[number].type != type)
            number = draw((uint32_t)apnc_variable_count);
        vr[k] = APNC_VR_STRIDE * number + (one_in(40) ? draw(100) : 0);
        if (one_in(60)) vr[k] = one_in(2) ? APNC_VR_TIME : draw(UINT32_MAX);
        values += (size_t)apnc_variables[number].count;
    }
    return one_in(20) ? draw(VALUES) : values;
}

static void set_values(fmi3Instance c) {
    fmi3ValueReference vr[SOME];
    fmi3Float64 real[VALUES];
    fmi3Int32 integer[VALUES];
    fmi3Int64 item[VALUES];
    fmi3Boolean flag[VALUES];
    const apnc_type type = (apnc_type)draw(4);
    const size_t n = draw(SOME), values = pick(vr, n, type);
    for (size_t k = 0; k < VALUES; k++) {
        real[k] = odd_real();
        integer[k] = one_in(4) ? (fmi3Int32)draw(UINT32_MAX) : (fmi3Int32)draw(300);
        item[k] = one_in(10) ? (fmi3Int64)draw(UINT32_MAX) << 8 : (fmi3Int64)draw(6);
        flag[k] = one_in(2);
    }
    if (type == APNC_REAL) count(fmi3SetFloat64(c, or_null(vr), n, or_null(real), values));
    if (type == APNC_INTEGER) count(fmi3SetInt32(c, or_null(vr), n, or_null(integer), values));
    if (type == APNC_ENUMERATION) count(fmi3SetInt64(c, or_null(vr), n, or_null(item), values));
    if (type == APNC_BOOLEAN) count(fmi3SetBoolean(c, or_null(vr), n, or_null(flag), values));
}

/* Room for exactly the values asked for, so that writing past them is seen. */
static void get_values(fmi3Instance c) {
    fmi3ValueReference vr[SOME];
    const apnc_type type = (apnc_type)draw(4);
    const size_t n = draw(SOME), values = pick(vr, n, type);
    void *room = malloc(values * sizeof(double) + 1);
    void *target = one_in(60) ? NULL : room;
    if (type == APNC_REAL) count(fmi3GetFloat64(c, or_null(vr), n, target, values));
    if (type == APNC_INTEGER) count(fmi3GetInt32(c, or_null(vr), n, target, values));
    if (type == APNC_ENUMERATION) count(fmi3GetInt64(c, or_null(vr), n, target, values));
    if (type == APNC_BOOLEAN) count(fmi3GetBoolean(c, or_null(vr), n, target, values));
    if (one_in(20)) count(fmi3GetString(c, vr, n, target, values));
    free(room);
}

static void step(int i) {
    fmi3Boolean event, terminate, early;
    fmi3Float64 last, t = now[i], h = 1.0 / 60.0;
    if (one_in(4)) h *= (double)draw(1000) / 50.0;
    if (one_in(20)) t = odd_real();
    if (one_in(20)) h = odd_real();
    if (h > 100.0 && h < 1e12) h = 100.0; /* long steps are tried, but not all day */
    if (count(fmi3DoStep(instance[i], t, h, fmi3True, &event, &terminate, &early,
                         one_in(60) ? NULL : &last)) > fmi3Warning)
        return;
    now[i] = t + h;
    if (last != now[i]) fault("last successful time is not the end of the step");
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
    for (uint32_t k = draw(4); k > 0; k--) {
        const size_t at = header + draw((uint32_t)apnc_saved_size() / 8) * 8;
        const double number = odd_real();
        memcpy(blob + at, &number, sizeof number);
    }
    if (one_in(4)) blob[draw((uint32_t)blob_size)] ^= (fmi3Byte)(1 << draw(8));
    if (one_in(2)) {
        const uint64_t sum = checksum(blob + header, apnc_saved_size());
        memcpy(blob + header - sizeof sum, &sum, sizeof sum);
    }
}

static void use_states(int i) {
    fmi3FMUState *s = &state[i][draw(STATES)];
    size_t size = 0;
    switch (draw(5)) {
    case 0:
        count(fmi3GetFMUState(instance[i], one_in(60) ? NULL : s));
        break;
    case 1:
        count(fmi3SetFMUState(instance[i], *s));
        break;
    case 2:
        count(fmi3FreeFMUState(instance[i], one_in(60) ? NULL : s));
        break;
    case 3:
        if (count(fmi3SerializedFMUStateSize(instance[i], *s, &size)) != fmi3OK) break;
        if (size > BLOB_ROOM) fault("saved state is larger than expected");
        if (one_in(10)) size = draw((uint32_t)size);
        if (count(fmi3SerializeFMUState(instance[i], *s, blob, size)) == fmi3OK) blob_size = size;
        break;
    default:
        if (!blob_size) break;
        if (one_in(2)) spoil();
        size = one_in(10) ? draw((uint32_t)blob_size) : blob_size;
        /* an exact copy, so that reading past its end is seen */
        fmi3Byte *copy = malloc(size + !size);
        memcpy(copy, blob, size);
        if (count(fmi3DeserializeFMUState(instance[i], copy, size, s)) == fmi3OK && one_in(2))
            count(fmi3SetFMUState(instance[i], *s));
        free(copy);
    }
}

static void make(int i) {
    calls++;
    instance[i] = fmi3InstantiateCoSimulation(
        one_in(20) ? NULL : "fuzz", one_in(20) ? "{x}" : or_null(APNC_GUID), or_null("/x"),
        one_in(2), one_in(2), one_in(20), one_in(2), NULL, one_in(20), NULL,
        one_in(3) ? NULL : log_message, NULL);
    now[i] = 0.0;
}

/* What belongs to an instance goes before it does. */
static void unmake(int i) {
    for (int k = 0; k < STATES; k++) {
        count(fmi3FreeFMUState(instance[i], &state[i][k]));
        if (state[i][k]) fault("state is not freed");
    }
    calls++;
    fmi3FreeInstance(instance[i]);
    instance[i] = NULL;
}

/* Straight to stepping, where most of the code is. */
static void begin(int i) {
    const double start = one_in(5) ? odd_real() : 0.0;
    count(fmi3Reset(instance[i]));
    for (uint32_t k = draw(4); k > 0; k--) set_values(instance[i]);
    now[i] = 0.0;
    if (count(fmi3EnterInitializationMode(instance[i], one_in(2), odd_real(), start, one_in(20),
                                          odd_real())) == fmi3OK)
        now[i] = start;
    if (count(fmi3ExitInitializationMode(instance[i])) == fmi3OK) return;
    count(fmi3Reset(instance[i]));
    count(fmi3EnterInitializationMode(instance[i], 0, 0.0, 0.0, 0, 0.0));
    count(fmi3ExitInitializationMode(instance[i]));
    now[i] = 0.0;
}

static void live(fmi3Instance c, int i) {
    const fmi3String names[] = {"logStatusError", one_in(4) ? NULL : "logEvents", "other"};
    switch (draw(10)) {
    case 0:
        count(fmi3Terminate(c));
        break;
    case 1:
        count(fmi3Reset(c));
        break;
    case 2:
        count(fmi3EnterInitializationMode(c, one_in(2), odd_real(), odd_real(), one_in(2),
                                          odd_real()));
        break;
    case 3:
        count(fmi3ExitInitializationMode(c));
        break;
    case 4:
        count(fmi3EnterEventMode(c));
        break;
    case 5:
        count(fmi3SetDebugLogging(c, one_in(2), draw(4), or_null(names)));
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
        const uint32_t what = draw(40);
        if (!instance[i] && !one_in(20))
            make(i);
        else if (what == 0 && instance[i] && one_in(4))
            unmake(i);
        else if (what < 6)
            live(instance[i], i);
        else if (what < 12 && instance[i])
            use_states(i);
        else if (what < 18)
            set_values(instance[i]);
        else if (what < 25)
            get_values(instance[i]);
        else
            step(i);
    }
    for (int i = 0; i < INSTANCES; i++)
        if (instance[i]) unmake(i);
    printf(
        "%ld calls, about %ld ticks: %ld ok, %ld warning, %ld discard, %ld error; %ld messages\n",
        calls, ticks, answers[fmi3OK], answers[fmi3Warning], answers[fmi3Discard],
        answers[fmi3Error], messages);
    return 0;
}
