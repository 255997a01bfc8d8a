// A stand-in OpenXR runtime: what a session without pictures, or with empty frames, calls. Two controllers are what a file of
// doubles says (struct Stage), which a test writes and this library maps. Calls out of order, unknown paths and unknown
// actions are refused with the errors of the specification (OpenXR 1.0, sections 2, 4, 6, 7, 9 and 11).
//
// Environment: STANDIN_STAGE (the file), STANDIN_PROFILE (the interaction profile that is held), STANDIN_HEADLESS (0: the runtime
// lacks XR_MND_headless, as SteamVR does).

#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

enum {
    OK = 0, EVENT_UNAVAILABLE = 4, NOT_FOCUSED = 8, VALIDATION = -1, FAILURE = -2, UNSUPPORTED = -7, EXTENSION = -9,
    SIZE = -11, HANDLE = -12, NOT_RUNNING = -16, RUNNING = -14, PATH_INVALID = -19, PATH_UNSUPPORTED = -22,
    TYPE_MISMATCH = -27, NOT_READY = -28, CALL_ORDER = -37, GRAPHICS = -38, NOT_ATTACHED = -46, ATTACHED = -47,
};
enum { IDLE = 1, READY, SYNCHRONIZED, VISIBLE, FOCUSED, STOPPING, LOSS, EXITING };

typedef struct { int32_t type; void *next; } Head;
typedef struct { float x, y, z, w; } Quat;
typedef struct { Quat turn; float x, y, z; } Pose;
typedef struct { char name[128]; uint32_t version; char engine[128]; uint32_t engine_version; uint64_t api; } App;
typedef struct { Head h; uint64_t flags; App app; uint32_t layers; const char *const *layer; uint32_t count; const char *const *names; } InstanceInfo;
typedef struct { Head h; char name[128]; uint32_t version; } Extension;
typedef struct { Head h; uint64_t version; char name[128]; } Properties;
typedef struct { Head h; uint64_t id; uint32_t vendor; char name[256]; uint32_t graphics[3], tracking[2]; } SystemProperties;
typedef struct { Head h; uint64_t session; int32_t state; int64_t time; } StateChanged;
typedef struct { Head h; uint64_t session; int32_t space; int64_t time; uint32_t valid; Pose pose; } SpaceChange;
typedef struct { Head h; uint64_t session; } ProfileChanged;
typedef struct { Head h; uint64_t flags; uint64_t system; } SessionInfo;
typedef struct { Head h; int64_t time, period; uint32_t render; } FrameState;
typedef struct { Head h; int64_t time; int32_t blend; uint32_t layers; const void *list; } FrameEnd;
typedef struct { Head h; int32_t type; Pose pose; } ReferenceInfo;
typedef struct { Head h; uint64_t action, path; Pose pose; } ActionSpaceInfo;
typedef struct { Head h; uint64_t flags; Pose pose; } Location;
typedef struct { Head h; char name[64]; int32_t type; uint32_t count; const uint64_t *paths; char title[128]; } ActionInfo;
typedef struct { uint64_t action, path; } Binding;
typedef struct { Head h; uint64_t profile; uint32_t count; const Binding *list; } Suggestion;
typedef struct { Head h; uint32_t count; const uint64_t *sets; } Attach;
typedef struct { Head h; uint64_t action, path; } Ask;
typedef struct { Head h; uint32_t value, changed; int64_t time; uint32_t active; } Bool;
typedef struct { Head h; float value; uint32_t changed; int64_t time; uint32_t active; } Float;
typedef struct { Head h; float x, y; uint32_t changed; int64_t time; uint32_t active; } Vector;
typedef struct { Head h; uint64_t profile; } Profile;
typedef struct { Head h; uint64_t lowest, highest; } Requirements;

/// What the test says of the controllers: position [m], quaternion (x, y, z, w), flags of the location, inputs 0 to 1.
typedef struct { double position[3], turn[4], flags, trigger, squeeze, stick[2], click, first, second; } Hand;
typedef struct { Hand right, left; double wanted, recentred, frames; } Stage;

/// The inputs of each profile for both hands, for the right, and for the left one (specification, section 6.4).
static const char *PROFILES[][4] = {
    { "/interaction_profiles/oculus/touch_controller",
      " grip/pose aim/pose trigger/value squeeze/value thumbstick thumbstick/x thumbstick/y thumbstick/click thumbstick/touch trigger/touch ",
      " a/click a/touch b/click b/touch system/click ", " x/click x/touch y/click y/touch menu/click " },
    { "/interaction_profiles/valve/index_controller",
      " grip/pose aim/pose trigger/value trigger/click squeeze/value squeeze/force thumbstick thumbstick/click trackpad trackpad/force a/click b/click system/click ", "", "" },
    { "/interaction_profiles/htc/vive_controller",
      " grip/pose aim/pose trigger/value trigger/click squeeze/click trackpad trackpad/click menu/click system/click ", "", "" },
    { "/interaction_profiles/khr/simple_controller", " grip/pose aim/pose select/click menu/click ", "", "" },
};

static Stage *stage;
static char paths[256][256];
static int32_t types[64];
static Binding bound[256];
static uint64_t spaces[64];
static int path_count, action_count, bound_count, space_count, attached, state, told, running, frame, headless, recentred, profile_told;

static int64_t now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return t.tv_sec * 1000000000ll + t.tv_nsec;
}

static const char *name_of(uint64_t path) { return path >= 1 && path <= (uint64_t)path_count ? paths[path - 1] : NULL; }

static int held(const char *profile) {
    const char *wanted = getenv("STANDIN_PROFILE");
    return !strcmp(profile, wanted ? wanted : PROFILES[0][0]);
}

/// The path of an input behind the hand it is of; NULL for other paths.
static const char *input_of(const char *path, int *is_left) {
    const char *right = "/user/hand/right/input/", *left = "/user/hand/left/input/";
    *is_left = !strncmp(path, left, strlen(left));
    if (*is_left) return path + strlen(left);
    return strncmp(path, right, strlen(right)) ? NULL : path + strlen(right);
}

static int one_of(const char *list, const char *word) {
    char padded[258];
    snprintf(padded, sizeof padded, " %s ", word);
    return strstr(list, padded) != NULL;
}

/// The input that is bound to an action for a hand; NULL for none.
static const char *source(uint64_t action, uint64_t hand, const Hand **of) {
    for (int i = 0; i < bound_count; i++) {
        int is_left;
        const char *input = input_of(name_of(bound[i].path), &is_left), *wanted = name_of(hand);
        if (bound[i].action != action || !wanted || is_left != !strcmp(wanted, "/user/hand/left")) continue;
        *of = is_left ? &stage->left : &stage->right;
        return input;
    }
    return NULL;
}

static double value(const Hand *hand, const char *input) {
    if (!strncmp(input, "trigger", 7)) return hand->trigger;
    if (!strncmp(input, "squeeze", 7) || !strncmp(input, "select", 6)) return hand->squeeze;
    if (!strcmp(input, "thumbstick/click") || !strcmp(input, "trackpad/click")) return hand->click;
    return strchr("axm", *input) ? hand->first : hand->second;
}

static int32_t enumerate_extensions(const char *layer, uint32_t capacity, uint32_t *count, Extension *list) {
    const char *with[] = { "XR_MND_headless", "XR_KHR_convert_timespec_time", "XR_KHR_opengl_enable" };
    const char *wanted = getenv("STANDIN_HEADLESS");
    uint32_t first = wanted && *wanted == '0' ? 2 : 0;
    (void)layer;
    *count = 3 - first;
    if (capacity == 0) return OK;
    if (capacity < *count) return SIZE;
    for (uint32_t i = 0; i < *count; i++) {
        snprintf(list[i].name, sizeof list[i].name, "%s", with[first + i]);
        list[i].version = 1;
    }
    return OK;
}

static int32_t create_instance(const InstanceInfo *info, uint64_t *instance) {
    const char *file = getenv("STANDIN_STAGE");
    int handle = open(file ? file : "", O_RDWR);
    if (handle < 0) return FAILURE;
    stage = mmap(NULL, sizeof *stage, PROT_READ | PROT_WRITE, MAP_SHARED, handle, 0);
    close(handle);
    if (stage == MAP_FAILED) return FAILURE;
    for (uint32_t i = 0; i < info->count; i++) headless |= !strcmp(info->names[i], "XR_MND_headless");
    *instance = 1;
    return OK;
}

static int32_t destroy(uint64_t handle) { return handle ? OK : HANDLE; }

static int32_t get_properties(uint64_t instance, Properties *out) {
    out->version = 1ull << 48 | 2ull << 32 | 3;
    snprintf(out->name, sizeof out->name, "stand-in");
    return destroy(instance);
}

static int32_t to_string(uint64_t instance, int32_t value, char *out) {
    snprintf(out, 64, "%d", value);
    return destroy(instance);
}

static int32_t get_system(uint64_t instance, const Head *info, uint64_t *system) {
    (void)info;
    *system = 7;
    return destroy(instance);
}

static int32_t get_system_properties(uint64_t instance, uint64_t system, SystemProperties *out) {
    out->id = system;
    snprintf(out->name, sizeof out->name, "controllers of a test");
    return destroy(instance);
}

static int32_t blend_modes(uint64_t instance, uint64_t system, int32_t view, uint32_t capacity, uint32_t *count, int32_t *list) {
    (void)system, (void)view;
    *count = 1;
    if (capacity) *list = 1;
    return destroy(instance);
}

static int32_t requirements(uint64_t instance, uint64_t system, Requirements *out) {
    (void)system;
    out->lowest = 3ull << 48, out->highest = 5ull << 48;
    return destroy(instance);
}

static int32_t create_session(uint64_t instance, const SessionInfo *info, uint64_t *session) {
    // Of what draws, only that it is named is looked at.
    if (info->system != 7 || (!headless && !info->h.next)) return GRAPHICS;
    *session = 2, state = told = IDLE;
    return destroy(instance);
}

static int32_t poll_event(uint64_t instance, Head *event) {
    // A state follows the one before it; a session that draws goes on after its first frame.
    if (state && stage->wanted > state && (state == IDLE || (running && (headless || stage->frames > 0)))) state++;
    if (running && stage->wanted < state) state = stage->wanted < SYNCHRONIZED ? STOPPING : stage->wanted;
    if (state != told) {
        StateChanged *changed = (StateChanged *)event;
        *changed = (StateChanged){ { 18, NULL }, 2, told = state, now() };
        return destroy(instance);
    }
    if (stage->recentred > recentred) {
        SpaceChange *change = (SpaceChange *)event;
        recentred = stage->recentred;
        *change = (SpaceChange){ { 40, NULL }, 2, 2, now(), 0, { { 0, 0, 0, 1 }, 0, 0, 0 } };
        return destroy(instance);
    }
    if (attached && state == FOCUSED && !profile_told) {
        profile_told = 1;
        *(ProfileChanged *)event = (ProfileChanged){ { 52, NULL }, 2 };
        return destroy(instance);
    }
    return EVENT_UNAVAILABLE;
}

static int32_t begin_session(uint64_t session, const Head *info) {
    (void)info;
    if (running) return RUNNING;
    if (state != READY) return NOT_READY;
    running = 1;
    return destroy(session);
}

static int32_t end_session(uint64_t session) {
    if (!running) return NOT_RUNNING;
    running = 0, state = stage->wanted > 0 ? IDLE : EXITING;
    return destroy(session);
}

static int32_t wait_frame(uint64_t session, const Head *info, FrameState *out) {
    (void)info;
    if (!running) return NOT_RUNNING;
    if (headless || frame) return CALL_ORDER;
    usleep(11000);
    frame = 1;
    *out = (FrameState){ out->h, now() + 20000000, 11000000, 1 };
    return destroy(session);
}

static int32_t begin_frame(uint64_t session, const Head *info) {
    (void)info;
    if (frame != 1) return CALL_ORDER;
    frame = 2;
    return destroy(session);
}

static int32_t end_frame(uint64_t session, const FrameEnd *info) {
    if (frame != 2) return CALL_ORDER;
    if (info->blend != 1 || info->layers || info->time <= 0) return VALIDATION;
    frame = 0, stage->frames += 1;
    return destroy(session);
}

static int32_t create_reference_space(uint64_t session, const ReferenceInfo *info, uint64_t *space) {
    if (info->type != 2) return VALIDATION;
    spaces[space_count++] = 0, *space = space_count;
    return destroy(session);
}

static int32_t create_action_space(uint64_t session, const ActionSpaceInfo *info, uint64_t *space) {
    if (types[info->action - 1] != 4) return TYPE_MISMATCH;
    spaces[space_count++] = info->action << 32 | info->path, *space = space_count;
    return destroy(session);
}

static int32_t locate_space(uint64_t space, uint64_t base, int64_t time, Location *out) {
    const Hand *hand;
    if (spaces[base - 1] || time <= 0) return VALIDATION;
    out->flags = 0;
    if (!source(spaces[space - 1] >> 32, spaces[space - 1] & 0xffffffff, &hand)) return OK;
    out->flags = hand->flags;
    const double *q = hand->turn, *p = hand->position;
    out->pose = (Pose){ { q[0], q[1], q[2], q[3] }, p[0], p[1], p[2] };
    return OK;
}

static int32_t string_to_path(uint64_t instance, const char *text, uint64_t *path) {
    if (*text != '/' || path_count == 256) return PATH_INVALID;
    for (*path = 1; *path <= (uint64_t)path_count; ++*path)
        if (!strcmp(name_of(*path), text)) return OK;
    snprintf(paths[path_count++], 256, "%s", text);
    return destroy(instance);
}

static int32_t path_to_string(uint64_t instance, uint64_t path, uint32_t capacity, uint32_t *count, char *out) {
    if (!name_of(path)) return PATH_INVALID;
    *count = strlen(name_of(path)) + 1;
    if (capacity) snprintf(out, capacity, "%s", name_of(path));
    return destroy(instance);
}

static int32_t create_action_set(uint64_t instance, const Head *info, uint64_t *set) {
    (void)info;
    *set = 3;
    return destroy(instance);
}

static int32_t create_action(uint64_t set, const ActionInfo *info, uint64_t *action) {
    if (attached) return ATTACHED;
    if (info->count != 2 || action_count == 64) return PATH_UNSUPPORTED;
    types[action_count++] = info->type, *action = action_count;
    return destroy(set);
}

static int32_t suggest(uint64_t instance, const Suggestion *info) {
    size_t row = 0, rows = sizeof PROFILES / sizeof *PROFILES;
    const char *profile = name_of(info->profile);
    while (profile && row < rows && strcmp(PROFILES[row][0], profile)) row++;
    if (attached) return ATTACHED;
    if (!profile || row == rows) return PATH_UNSUPPORTED;
    for (uint32_t i = 0; i < info->count; i++) {
        int is_left;
        const char *path = name_of(info->list[i].path), *input = path ? input_of(path, &is_left) : NULL;
        if (!input || (!one_of(PROFILES[row][1], input) && !one_of(PROFILES[row][is_left ? 3 : 2], input))) return PATH_UNSUPPORTED;
        if (held(profile)) bound[bound_count++] = info->list[i];
    }
    return destroy(instance);
}

static int32_t attach(uint64_t session, const Attach *info) {
    if (attached) return ATTACHED;
    attached = info->count == 1 && *info->sets == 3;
    return attached ? destroy(session) : HANDLE;
}

static int32_t current_profile(uint64_t session, uint64_t hand, Profile *out) {
    const char *wanted = getenv("STANDIN_PROFILE");
    if (!name_of(hand)) return PATH_INVALID;
    return string_to_path(session, wanted ? wanted : PROFILES[0][0], &out->profile);
}

static int32_t sync_actions(uint64_t session, const Head *info) {
    (void)info;
    if (!attached) return NOT_ATTACHED;
    return state == FOCUSED ? destroy(session) : NOT_FOCUSED;
}

static int32_t get_bool(uint64_t session, const Ask *ask, Bool *out) {
    const Hand *hand;
    const char *input = source(ask->action, ask->path, &hand);
    if (types[ask->action - 1] != 1) return TYPE_MISMATCH;
    *out = (Bool){ out->h, input && value(hand, input) > 0.5, 0, now(), input && state == FOCUSED };
    return destroy(session);
}

static int32_t get_float(uint64_t session, const Ask *ask, Float *out) {
    const Hand *hand;
    const char *input = source(ask->action, ask->path, &hand);
    if (types[ask->action - 1] != 2) return TYPE_MISMATCH;
    *out = (Float){ out->h, input ? value(hand, input) : 0, 0, now(), input && state == FOCUSED };
    return destroy(session);
}

static int32_t get_vector(uint64_t session, const Ask *ask, Vector *out) {
    const Hand *hand;
    const char *input = source(ask->action, ask->path, &hand);
    if (types[ask->action - 1] != 3) return TYPE_MISMATCH;
    *out = (Vector){ out->h, input ? hand->stick[0] : 0, input ? hand->stick[1] : 0, 0, now(), input && state == FOCUSED };
    return destroy(session);
}

static int32_t to_time(uint64_t instance, const struct timespec *from, int64_t *out) {
    *out = from->tv_sec * 1000000000ll + from->tv_nsec;
    return destroy(instance);
}

typedef void (*Any)(void);
static int32_t get_address(uint64_t instance, const char *name, Any *out);

static const struct { const char *name; Any function; } TABLE[] = {
    { "GetInstanceProcAddr", (Any)get_address }, { "EnumerateInstanceExtensionProperties", (Any)enumerate_extensions },
    { "CreateInstance", (Any)create_instance }, { "DestroyInstance", (Any)destroy }, { "GetInstanceProperties", (Any)get_properties },
    { "ResultToString", (Any)to_string }, { "StructureTypeToString", (Any)to_string }, { "PollEvent", (Any)poll_event },
    { "GetSystem", (Any)get_system }, { "GetSystemProperties", (Any)get_system_properties },
    { "EnumerateEnvironmentBlendModes", (Any)blend_modes }, { "GetOpenGLGraphicsRequirementsKHR", (Any)requirements },
    { "CreateSession", (Any)create_session }, { "DestroySession", (Any)destroy }, { "BeginSession", (Any)begin_session },
    { "EndSession", (Any)end_session }, { "WaitFrame", (Any)wait_frame }, { "BeginFrame", (Any)begin_frame },
    { "EndFrame", (Any)end_frame }, { "CreateReferenceSpace", (Any)create_reference_space },
    { "CreateActionSpace", (Any)create_action_space }, { "LocateSpace", (Any)locate_space }, { "DestroySpace", (Any)destroy },
    { "StringToPath", (Any)string_to_path }, { "PathToString", (Any)path_to_string }, { "CreateActionSet", (Any)create_action_set },
    { "DestroyActionSet", (Any)destroy }, { "CreateAction", (Any)create_action }, { "DestroyAction", (Any)destroy },
    { "SuggestInteractionProfileBindings", (Any)suggest }, { "AttachSessionActionSets", (Any)attach },
    { "GetCurrentInteractionProfile", (Any)current_profile }, { "SyncActions", (Any)sync_actions },
    { "GetActionStateBoolean", (Any)get_bool }, { "GetActionStateFloat", (Any)get_float },
    { "GetActionStateVector2f", (Any)get_vector }, { "ConvertTimespecTimeToTimeKHR", (Any)to_time },
};

static int32_t get_address(uint64_t instance, const char *name, Any *out) {
    (void)instance;
    *out = NULL;
    for (size_t i = 0; i < sizeof TABLE / sizeof *TABLE; i++)
        if (!strncmp(name, "xr", 2) && !strcmp(name + 2, TABLE[i].name)) *out = TABLE[i].function;
    return *out ? OK : UNSUPPORTED;
}

typedef struct { uint32_t kind, version; size_t size; uint32_t lowest, highest; uint64_t lowest_api, highest_api; } LoaderInfo;
typedef struct { uint32_t kind, version; size_t size; uint32_t interface; uint64_t api; Any get_address; } RuntimeRequest;

int32_t xrNegotiateLoaderRuntimeInterface(const LoaderInfo *loader, RuntimeRequest *request) {
    if (loader->lowest > 1 || loader->highest < 1) return FAILURE;
    request->interface = 1, request->api = 1ull << 48, request->get_address = (Any)get_address;
    return OK;
}
