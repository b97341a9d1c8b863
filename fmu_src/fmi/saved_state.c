/* Saved states as bytes: a header that tells what follows, then the run as it lies in memory. */
#include <math.h>
#include <string.h>

#include "instance.h"

/* Header of a saved state. */
typedef struct {
    char magic[8];
    char build[40];    /* its guid: sources and all choices of the build */
    uint64_t size;     /* of apnc_run [bytes] */
    uint64_t checksum; /* FNV-1a of apnc_run */
} blob_header;

#define BLOB_MAGIC "APNCrun"
#define MAX_TICK   (INT64_C(1) << 53) /* the largest that is still exact as a double */

static uint64_t checksum(const unsigned char *bytes, size_t size) {
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < size; i++) hash = (hash ^ bytes[i]) * 1099511628211u;
    return hash;
}

size_t apnc_blob_size(void) { return sizeof(blob_header) + sizeof(apnc_run); }

void apnc_blob_write(const apnc_run *run, unsigned char *blob) {
    blob_header header = {BLOB_MAGIC, APNC_GUID, sizeof *run, 0};
    header.checksum = checksum((const unsigned char *)run, sizeof *run);
    memcpy(blob, &header, sizeof header);
    memcpy(blob + sizeof header, run, sizeof *run);
}

/* Whether a run can be stepped: a blob may be made by hand, its checksum with it. */
static int sound(const apnc_run *run) {
    const int32_t oldest = run->state.estimation.oldest;
    const int32_t phase = run->phase;
    if (phase != APNC_INSTANTIATED && phase != APNC_INITIALIZATION && phase != APNC_STEPPING &&
        phase != APNC_TERMINATED)
        return 0;
    if (!isfinite(run->start_time) || !isfinite(run->time)) return 0;
    if (!(run->stop_time >= run->start_time)) return 0;
    if (run->next_tick < 0 || run->next_tick > MAX_TICK) return 0;
    if (run->state.ticks < 0 || run->state.ticks > MAX_TICK) return 0;
    if (oldest < 0 || oldest >= APNC_WINDOW_MAX) return 0;
    if (phase != APNC_STEPPING) return 1;
    return apnc_parameters_in_range(&run->data) && oldest < run->data.parameters.N;
}

apnc_status apnc_blob_read(apnc_instance *instance, const unsigned char *blob, size_t size,
                           apnc_run *run) {
    const blob_header own = {BLOB_MAGIC, APNC_GUID, sizeof *run, 0};
    blob_header header;
    if (size < sizeof header)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "saved state of %lu bytes is too short", (unsigned long)size);
    memcpy(&header, blob, sizeof header);
    if (memcmp(header.magic, BLOB_MAGIC, sizeof header.magic) != 0)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR, "not a saved state of this FMU");
    if (memcmp(header.build, own.build, sizeof own.build) != 0 || header.size != own.size)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "saved state was made by another build of the FMU, not by %s",
                           APNC_GUID);
    if (size != apnc_blob_size())
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "saved state has %lu bytes; %lu are needed", (unsigned long)size,
                           (unsigned long)apnc_blob_size());
    if (header.checksum != checksum(blob + sizeof header, sizeof *run))
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR, "saved state is damaged");
    memcpy(run, blob + sizeof header, sizeof *run);
    if (!sound(run))
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR, "saved state is inconsistent");
    return APNC_OK;
}
