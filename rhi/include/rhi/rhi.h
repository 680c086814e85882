// The whole interface.
#pragma once

#include "rhi/device.h"
#include "rhi/messages.h"
#include "rhi/ref.h"
#include "rhi/shader.h"
#include "rhi/types.h"
