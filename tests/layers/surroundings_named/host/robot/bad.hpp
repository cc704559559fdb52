#pragma once

const char* const kHint = "no permission (sudo usermod -aG dialout)";
