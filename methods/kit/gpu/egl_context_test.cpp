#include "methods/kit/gpu/egl_context.h"

#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "methods/kit/gpu/device.h"
#include "methods/kit/gpu/texture.h"

namespace dustbench::gpu {
namespace {

Texture filled(Device& device, float value) {
    Texture texture = Texture::make2D(device, "filled", Format::rgba32F, 2, 2);
    texture.write(std::span<const float>(std::vector<float>(16, value)));
    return texture;
}

TEST(CurrentContext, IsMadeCurrentAgainWithWhatIsOnIt) {
    Device first;
    const CurrentContext ofFirst;
    const Texture onFirst = filled(first, 0.25f);
    {
        Device second;
        const CurrentContext ofSecond;
        const Texture onSecond = filled(second, 0.75f);
        ASSERT_EQ(onSecond.name().get(), onFirst.name().get());  // each in its own context
        for (int n = 0; n < 3; ++n) {
            ofFirst.makeCurrent();
            EXPECT_EQ(onFirst.readFloats(), std::vector<float>(16, 0.25f));
            ofSecond.makeCurrent();
            EXPECT_EQ(onSecond.readFloats(), std::vector<float>(16, 0.75f));
        }
    }
    ofFirst.makeCurrent();
    EXPECT_EQ(onFirst.readFloats(), std::vector<float>(16, 0.25f));
    EXPECT_FALSE(isContextLost());
}

}  // namespace
}  // namespace dustbench::gpu
