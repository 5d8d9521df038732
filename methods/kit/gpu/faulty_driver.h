// Faults between the program and the driver, for tests: they replace the pointers through which libepoxy calls OpenGL,
// for as long as the object lives.
//
// Threads: the device's. One fault of a kind at a time.
#pragma once

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <chrono>
#include <limits>
#include <utility>

namespace dustbench::gpu {

/// An OpenGL function replaced by `fault`.
template <typename Function>
class ReplacedFunction {
 public:
    ReplacedFunction(Function& pointer, Function fault) : pointer_(pointer), original_(std::exchange(pointer, fault)) {}
    ~ReplacedFunction() { pointer_ = original_; }
    ReplacedFunction(const ReplacedFunction&) = delete;
    ReplacedFunction& operator=(const ReplacedFunction&) = delete;

 private:
    Function& pointer_;
    Function original_;
};

/// The driver's own function, whatever the pointer holds.
template <typename Function>
Function ofDriver(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

/// Textures of 32-bit floats have 16 bits.
class FewerBits {
    static void store(GLuint texture, GLsizei levels, GLenum format, GLsizei width, GLsizei height) {
        ofDriver<PFNGLTEXTURESTORAGE2DPROC>("glTextureStorage2D")(
            texture, levels, format == GL_RGBA32F ? GL_RGBA16F : format, width, height);
    }
    ReplacedFunction<PFNGLTEXTURESTORAGE2DPROC> storage_{epoxy_glTextureStorage2D, store};
};

/// The first value read back from a texture is not a number.
class PoisonedTextures {
    static void read(GLuint texture, GLint level, GLenum format, GLenum type, GLsizei bytes, void* values) {
        ofDriver<PFNGLGETTEXTUREIMAGEPROC>("glGetTextureImage")(texture, level, format, type, bytes, values);
        if (type == GL_FLOAT) *static_cast<float*>(values) = std::numeric_limits<float>::quiet_NaN();
    }
    ReplacedFunction<PFNGLGETTEXTUREIMAGEPROC> read_{epoxy_glGetTextureImage, read};
};

/// Instances are drawn last to first.
class ReversedInstances {
    static void draw(GLenum mode, GLint first, GLsizei count, GLsizei instances) {
        for (GLsizei i = instances; i-- > 0;)
            glDrawArraysInstancedBaseInstance(mode, first, count, 1, static_cast<GLuint>(i));
    }
    ReplacedFunction<PFNGLDRAWARRAYSINSTANCEDPROC> draw_{epoxy_glDrawArraysInstanced, draw};
};

/// The writes of every fifth dispatch are lost.
class LostWrites {
    static inline int dispatches_ = 0;
    static void dispatch(GLuint x, GLuint y, GLuint z) {
        if (++dispatches_ % 5 != 0) ofDriver<PFNGLDISPATCHCOMPUTEPROC>("glDispatchCompute")(x, y, z);
    }
    ReplacedFunction<PFNGLDISPATCHCOMPUTEPROC> dispatch_{epoxy_glDispatchCompute, dispatch};
};

/// Counts the calls that bring data of the GPU to the CPU, and so wait for it.
class CountedReadBacks {
 public:
    CountedReadBacks() { count_ = 0; }
    [[nodiscard]] static int count() { return count_; }

 private:
    static inline int count_ = 0;
    static void buffer(GLuint name, GLintptr first, GLsizeiptr bytes, void* values) {
        ++count_;
        ofDriver<PFNGLGETNAMEDBUFFERSUBDATAPROC>("glGetNamedBufferSubData")(name, first, bytes, values);
    }
    static void* map(GLuint name, GLintptr first, GLsizeiptr bytes, GLbitfield access) {
        if (access & GL_MAP_READ_BIT) ++count_;
        return ofDriver<PFNGLMAPNAMEDBUFFERRANGEPROC>("glMapNamedBufferRange")(name, first, bytes, access);
    }
    static void texture(GLuint name, GLint level, GLenum format, GLenum type, GLsizei bytes, void* values) {
        ++count_;
        ofDriver<PFNGLGETTEXTUREIMAGEPROC>("glGetTextureImage")(name, level, format, type, bytes, values);
    }
    ReplacedFunction<PFNGLGETNAMEDBUFFERSUBDATAPROC> buffer_{epoxy_glGetNamedBufferSubData, buffer};
    ReplacedFunction<PFNGLMAPNAMEDBUFFERRANGEPROC> map_{epoxy_glMapNamedBufferRange, map};
    ReplacedFunction<PFNGLGETTEXTUREIMAGEPROC> texture_{epoxy_glGetTextureImage, texture};
};

/// Counts compute dispatches whose writes no barrier makes visible before the next dispatch. A software device runs
/// them one after the other and shows no difference.
class WatchedBarriers {
 public:
    WatchedBarriers() { dispatches_ = missing_ = 0, open_ = false; }
    [[nodiscard]] static int dispatches() { return dispatches_; }
    [[nodiscard]] static int missing() { return missing_ + (open_ ? 1 : 0); }

 private:
    static inline int dispatches_ = 0, missing_ = 0;
    static inline bool open_ = false;
    static void begin() {
        ++dispatches_;
        if (open_) ++missing_;
        open_ = true;
    }
    static void dispatch(GLuint x, GLuint y, GLuint z) {
        begin();
        ofDriver<PFNGLDISPATCHCOMPUTEPROC>("glDispatchCompute")(x, y, z);
    }
    static void indirect(GLintptr first) {
        begin();
        ofDriver<PFNGLDISPATCHCOMPUTEINDIRECTPROC>("glDispatchComputeIndirect")(first);
    }
    static void barrier(GLbitfield bits) {
        constexpr GLbitfield needed =
            GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT;
        if ((bits & needed) == needed) open_ = false;
        ofDriver<PFNGLMEMORYBARRIERPROC>("glMemoryBarrier")(bits);
    }
    ReplacedFunction<PFNGLDISPATCHCOMPUTEPROC> dispatch_{epoxy_glDispatchCompute, dispatch};
    ReplacedFunction<PFNGLDISPATCHCOMPUTEINDIRECTPROC> indirect_{epoxy_glDispatchComputeIndirect, indirect};
    ReplacedFunction<PFNGLMEMORYBARRIERPROC> barrier_{epoxy_glMemoryBarrier, barrier};
};

/// Timer queries report the elapsed time, waited for, times a factor.
class ScaledTimer {
 public:
    explicit ScaledTimer(double factor) { factor_ = factor; }

 private:
    using Clock = std::chrono::steady_clock;
    static inline Clock::time_point begin_{};
    static inline double nanoseconds_ = 0, factor_ = 1;
    static void begin(GLenum, GLuint) {
        glFinish();
        begin_ = Clock::now();
    }
    static void end(GLenum) {
        glFinish();
        nanoseconds_ = std::chrono::duration<double, std::nano>(Clock::now() - begin_).count();
    }
    static void ready(GLuint, GLenum, GLint* value) { *value = 1; }
    static void answer(GLuint, GLenum, GLuint64* value) { *value = static_cast<GLuint64>(nanoseconds_ * factor_); }

    ReplacedFunction<PFNGLBEGINQUERYPROC> beginQuery_{epoxy_glBeginQuery, begin};
    ReplacedFunction<PFNGLENDQUERYPROC> endQuery_{epoxy_glEndQuery, end};
    ReplacedFunction<PFNGLGETQUERYOBJECTIVPROC> ready_{epoxy_glGetQueryObjectiv, ready};
    ReplacedFunction<PFNGLGETQUERYOBJECTUI64VPROC> answer_{epoxy_glGetQueryObjectui64v, answer};
};

}  // namespace dustbench::gpu
