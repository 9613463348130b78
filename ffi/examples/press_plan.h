// Servo press, 60 mm stroke, 10 kN: 10 rows, 388 bytes, 0.4518 s; errors against the motion at most 1.412e-5 deg, 6.093e-5 rad/s and 0.2151 rad/s^2; the rate cannot be changed, because the motion uses the drive's full torque (--reserve leaves some)
#ifndef PRESS_PLAN_TABLE
#define PRESS_PLAN_TABLE 0xf9563a47u

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Identifier of the machine: that of another in jred_info is another machine's. */
#define PRESS_PLAN_MACHINE 0x3d4c7e82u

extern const uint32_t press_plan_words[97];
const uint32_t press_plan_words[97] = {
    0x4c50524au, 0x00100001u, 0x00000061u, 0x09062000u, 0x0000000au, 0x00000000u, 0x00000000u, 0x3d4c7e82u,
    0x41e00000u, 0x435c02d4u, 0x34845574u, 0x387f902au, 0x3e5c44c7u, 0x7f800000u, 0x00000000u, 0x00000000u,
    0x00000000u, 0x80000000u, 0x00000001u, 0x00000000u, 0x1181cd9eu, 0x00000004u, 0xfffffff8u, 0x00000005u,
    0x2094f209u, 0xc89909acu, 0x00000011u, 0x11d34a60u, 0x00000000u, 0xff393bffu, 0x015af385u, 0xff5eb124u,
    0x2778fccbu, 0xe74e34b9u, 0x00000000u, 0x11d34a60u, 0x00000000u, 0xfb5d5f03u, 0x01558984u, 0xfff911a1u,
    0x27ee5bb5u, 0xe957ecfbu, 0x00000001u, 0x11b498b9u, 0xf38a9ce5u, 0xfff45146u, 0x022ad441u, 0xff5c7ba3u,
    0x28591e42u, 0xeb2e8231u, 0x00000000u, 0x1191cf71u, 0xfc6239a9u, 0x05bbd8dau, 0x006b75cau, 0x0002a6d3u,
    0x29a84fe9u, 0xf0efe907u, 0x00000001u, 0x11c3b34bu, 0x1181cd9eu, 0x0000ddd5u, 0xfffe8a45u, 0x0000a7e4u,
    0x29c4cef4u, 0xf16eaeadu, 0x00000017u, 0x11d34a60u, 0x00000000u, 0xfeeab8abu, 0x01b95b69u, 0xff4886a6u,
    0x3978508bu, 0x3766f654u, 0x00000101u, 0x11d34a60u, 0xee7e3262u, 0x00000000u, 0xfffffffeu, 0x00000003u,
    0x5a0d4294u, 0x80000000u, 0x0000011fu, 0x00000000u, 0x00000000u, 0x00000000u, 0x00000000u, 0x00000000u,
    0x73a6dc2eu, 0x80000000u, 0x00000100u, 0x00000000u, 0x00000000u, 0x00000000u, 0x00000000u, 0x00000000u,
    0x529dc5acu,
};

#ifdef __cplusplus
}
#endif

#elif PRESS_PLAN_TABLE != 0xf9563a47u
#error "two tables have the name press_plan in one program: write one of the plans to a file of another name"
#endif
