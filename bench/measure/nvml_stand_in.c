/* Stand-in for NVML, for tests: two GPUs with energy counters that grow by 1500 mJ and clocks that fall by 100 MHz at each call. */
#include <string.h>

#ifndef FIRST_GPU
#define FIRST_GPU "Stand-in One"
#endif

static unsigned long long used[2] = {1000, 5000};

int nvmlInit_v2(void) { return 0; }
int nvmlShutdown(void) { return 0; }
int nvmlDeviceGetCount_v2(unsigned int* count) {
    *count = 2;
    return 0;
}
int nvmlDeviceGetHandleByIndex_v2(unsigned int index, void** device) {
    *device = &used[index];
    return 0;
}
int nvmlDeviceGetName(void* device, char* name, unsigned int length) {
    strncpy(name, device == &used[0] ? FIRST_GPU : "Stand-in Two", length);
    return 0;
}
int nvmlDeviceGetTotalEnergyConsumption(void* device, unsigned long long* millijoules) {
    *millijoules = *(unsigned long long*)device += 1500;
    return 0;
}

static unsigned int clocks[2] = {1800, 900};

int nvmlDeviceGetClockInfo(void* device, int type, unsigned int* megahertz) {
    unsigned int* clock = &clocks[device == &used[1]];
    *megahertz = *clock;
    *clock -= 100;
    return type == 0 ? 0 : 2;
}
int nvmlDeviceGetCurrentClocksThrottleReasons(void* device, unsigned long long* reasons) {
    *reasons = device == &used[1] ? 0x24 : 0x1;
    return 0;
}
