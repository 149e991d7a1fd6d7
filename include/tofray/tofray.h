// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tofray/analysis.h"
#include "tofray/budget.h"
#include "tofray/camera.h"
#include "tofray/camera_report.h"
#include "tofray/error.h"
#include "tofray/file_record.h"
#include "tofray/frame.h"
#include "tofray/load.h"
#include "tofray/pixel.h"
#include "tofray/run.h"
#include "tofray/save.h"
#include "tofray/scene.h"
#include "tofray/simulator.h"
#include "tofray/stages.h"
