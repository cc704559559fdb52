#pragma once

void add_info();
