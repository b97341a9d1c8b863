/* Saved states as bytes: a header that tells what follows, then the block as it lies in memory. */
#include <math.h>
#include <string.h>

#include "instance.h"
#include "model.h"

#ifndef APNC_GUID
#error "APNC_GUID must be the guid of the model description"
#endif

/* Header of a saved state. */
typedef struct {
    char magic[8];
    char build[40];    /* its guid: sources and all choices of the build */
    uint64_t size;     /* of the block [bytes] */
    uint64_t checksum; /* FNV-1a of the block */
} blob_header;

#define BLOB_MAGIC "APNCrun"

static uint64_t checksum(const unsigned char *bytes, size_t size) {
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < size; i++) hash = (hash ^ bytes[i]) * 1099511628211u;
    return hash;
}

size_t apnc_blob_size(void) { return sizeof(blob_header) + apnc_saved_size(); }

void apnc_blob_write(const void *saved, unsigned char *blob) {
    const size_t size = apnc_saved_size();
    blob_header header = {BLOB_MAGIC, APNC_GUID, size, 0};
    header.checksum = checksum(saved, size);
    memcpy(blob, &header, sizeof header);
    memcpy(blob + sizeof header, saved, size);
}

/* Whether a state can be stepped: a blob may be made by hand, its checksum with it. */
static int sound(const void *saved) {
    const apnc_run *run = (const apnc_run *)(const void *)((const char *)saved + apnc_run_at());
    const int32_t phase = run->phase;
    if (phase != APNC_INSTANTIATED && phase != APNC_INITIALIZATION && phase != APNC_STEPPING &&
        phase != APNC_TERMINATED)
        return 0;
    if (!isfinite(run->start_time) || !isfinite(run->time)) return 0;
    if (!(run->stop_time >= run->start_time)) return 0;
    if (phase == APNC_STEPPING && !apnc_parameters_in_range(saved)) return 0;
    return apnc_model_sound(saved, run, (const char *)saved + apnc_state_at());
}

apnc_status apnc_blob_read(apnc_instance *instance, const unsigned char *blob, size_t size,
                           void *saved) {
    const blob_header own = {BLOB_MAGIC, APNC_GUID, apnc_saved_size(), 0};
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
    if (header.checksum != checksum(blob + sizeof header, own.size))
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR, "saved state is damaged");
    memcpy(saved, blob + sizeof header, own.size);
    if (!sound(saved))
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR, "saved state is inconsistent");
    return APNC_OK;
}
